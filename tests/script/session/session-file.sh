# `save session`: read in a fresh program it has the same runs and the same numbers of them.
cat >scene.lag <<'END'
param m = 1, l = 1, g = 9.81, c = 0.1
param unit = m*c^2
coord theta, x
particle bob mass m at (l*sin(theta), -l*cos(theta))
particle box mass m at (x, 0)
gravity (0, -g)
dissipation c*x'^2/2
E0 = m*l^2*theta'^2/2 - m*g*l*cos(theta)
Ltheta = p[theta]^2/(2*m*l^2)
start theta = 1, x' = 1
run 0..2 tol 1e-9 with c = 1/4, theta = 1/2 as a
A1 = value(theta, 2)
run 0..l for l = [1, 2]
B1 = value(theta, 1)
B2 = A1 + 2*B1
M[k] = max(a.theta, 0..k) for k = 1..2
start a
run 0..1/2 method radau as later
reset start
start theta = 0.3, theta' = 0.2 exactly
run 0..0.7 as other
set c = 0.3
set g = value(theta, 1/2) + 9
END
ask='value(a.theta, 2); value(run2.theta, 1); value(run2.l, 0); value(run3.theta, 1); value(later.x, 1/4)
value(other.theta, 1/2); A1; B1; B2; M[1]; M[2]; value(a.Ltheta, 1); g; Ltheta; E0
run 0..1 as last
value(theta, 1)'
{ cat scene.lag; echo 'save session to "session.lag"'; } >whole.lag
qdot -q whole.lag >/dev/null || echo 'not saved'
sed 's/error [0-9.e-]*/error E/; s/^\(set g = \)[0-9]*\/[0-9]* #/\1RATIO #/' session.lag
qdot --json scene.lag -e "$ask" | sed 's/,"statement.*//' | grep -v '"run"\|"notice"' | tail -n 17 >one
qdot --json session.lag -e "$ask" | sed 's/,"statement.*//' | grep -v '"run"\|"notice"' | tail -n 17 >two
cmp one two && grep -c . two
qdot -q session.lag -e 'save session to "again.lag"' >/dev/null
sed -i 's/ # .*//' session.lag again.lag
cmp session.lag again.lag && echo 'written again the same'

# What cannot be made again is told.
qdot -q -e "coord x; param k; particle p mass 1 at x; potential k*x^2/2; set k = 1; start x = 1; run 0..1 as a
B = value(x, 1); run 0..2 as b; C = value(x, 1); remove potential; run 0..3 as a
save session to \"lost.lag\"" | grep notice
sed 's/, 0.*//' lost.lag
qdot -q -e "coord x; lagrangian x'^2/2; start x = 1; run 0..1; B = value(x, 1); scene to \"plain.lag\"" | grep notice
cat plain.lag
