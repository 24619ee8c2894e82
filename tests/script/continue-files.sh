# Branches as JSON, files, figures.
cat >hoop.lag <<'END'
param m, g, R > 0, Omega
coord theta
particle bead mass m at (R*sin(theta)*cos(Omega*t), R*sin(theta)*sin(Omega*t), -R*cos(theta))
gravity (0, 0, -g)
set m = 1, g = 9.81, R = 1
END
# every point is an equilibrium: sin(theta) = 0, or cos(theta) = g/(R*Omega^2), stable as is known
qdot -q --json hoop.lag - <<'END' >hoop.json
continue equilibria in Omega = 0..10
END
awk -F'[][,:}]*' '/"name":"branch/ {
        match($0, /"values":\[[^]]*/); split(substr($0, RSTART + 10, RLENGTH - 10), v, ",")
        s = sin(v[2]); c = cos(v[2]); off = s*(9.81 - v[1]^2*c); if (off < 0) off = -off
        if (off > 1e-12) print "no equilibrium: " $0
        want = s*s < 1e-20 ? (c > 0 && v[1]^2 < 9.81 ? "true" : "false") : "true"
        near = v[1]^2 - 9.81; if (near < 0) near = -near
        if (near > 1e-6 && $0 !~ "\"stable\":" want "}") print "not " want ": " $0
        n++ }
    END { print (n > 300 ? "many points" : n " points") }' hoop.json
grep -c '"stable":null' hoop.json
grep bifurcation hoop.json
# tables and files
qdot -q --json hoop.lag -e 'continue equilibria in Omega = 0..10 as b; table b_bifurcations' | tail -n 1
qdot -q hoop.lag - <<'END'
continue equilibria in Omega = 3..3.5 as b
save b to "b.csv"
save b_bifurcations to "points.csv"
save b_bifurcations to "points.json"
plot b to "b.svg" keep
undo 4
table b
END
head -n 1 b.csv; cat points.csv points.json
grep -o "dashtype [^ ]*\|with points\|title \"[^\"]*\"" b.gp
# `plot` alone shows the latest ones
qdot -q hoop.lag -e 'continue equilibria in Omega = 0..10' -e 'plot to "hoop.svg" title "a hoop"' | tail -n 1
# flutter without damping is stable to first order before it: true
qdot -q --json - <<'END' | grep -v branch
coord theta1, theta2
param P
r1 = (cos(theta1), sin(theta1))
r2 = r1 + (cos(theta2), sin(theta2))
particle a mass 2 at r1
particle b mass 1 at r2
potential theta1^2/2 + (theta2 - theta1)^2/2
force -P*(cos(theta2), sin(theta2)) on b
continue equilibria in P = 0..4
END
