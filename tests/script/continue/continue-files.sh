# Branches as JSON, files, figures.
cat >hoop.lag <<'END'
param m, g, R > 0, Omega
coord theta
particle bead mass m at (R*sin(theta)*cos(Omega*t), R*sin(theta)*sin(Omega*t), -R*cos(theta))
gravity (0, 0, -g)
set m = 1, g = 9.81, R = 1
END
# every point is an equilibrium: sin(theta) = 0, or cos(theta) = g/(R*Omega^2), stable as is known
qdot -q --json hoop.lag - <<'END' | sed 's/,"statement.*}/}/' | grep -v '"columns"' >hoop.json
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
# bifurcations against closed forms: type, parameter
near() # SCRIPT on the standard input; TYPE VALUE pairs
{
    qdot -q --json - | sed -n 's/.*"bifurcation","type":"\(.*\)","values":\[\([^],]*\).*/\1:\2/p' |
        awk -F: -v all="$*" '{ n = split(all, w, "; *"); split(w[NR], v, ":")
            d = $2 - v[2]; d = d < 0 ? -d : d; s = v[2] < 0 ? -v[2] : v[2]
            print $1, ($1 == v[1] && d <= 4e-16*(s > 1 ? s : 1) ? "agrees" : "at " $2 ", not " w[NR]) }'
}
near 'fold:0.54433105395181736' <<'END'
param U
coord x < 1
particle plate mass 1 at x
spring between plate, 0 stiffness 1
force U^2/(2*(1 - x)^2) on plate
continue equilibria in U = 0..1
END
near 'hopf:1.4692857142857143' <<'END'
param P
coord theta1, theta2
r1 = (cos(theta1), sin(theta1))
r2 = r1 + (cos(theta2), sin(theta2))
particle a mass 2 at r1
particle b mass 1 at r2
potential theta1^2/2 + (theta2 - theta1)^2/2
dissipation theta1'^2/20 + (theta2' - theta1')^2/20
force -P*(cos(theta2), sin(theta2)) on b
continue equilibria in P = 0..4
END
near 'hamiltonian hopf:1.2071067811865475' <<'END'
param W
coord x, y
lagrangian (x'^2 + y'^2)/2 + W*(x*y' - y*x') + (x^2 + 2*y^2)/2
continue equilibria in W = 0..3
END
near 'pitchfork:0; fold:-0.25; fold:-0.25' <<'END'
param mu
coord x
lagrangian x'^2/2 + mu*x^2/2 + x^4/4 - x^6/6
continue equilibria in mu = -1..0.5
END
# a cusp: x^3 = b*x + a folds at a^2 = 4/27 for b = 1
near 'fold:0.38490017945975052; fold:-0.38490017945975052' <<'END'
param a
coord x
lagrangian x'^2/2 - x^4/4 + x^2/2 + a*x
continue equilibria in a = -1..1
END
# Wells one beside the other: no step goes from the curve of one to that of the next, where both begin.
cat >wells.lag <<'EOF'
coord theta, z
param Omega
particle b mass 1 at (sin(theta)*cos(Omega*t), sin(theta)*sin(Omega*t), -cos(theta))
particle c mass 1/2 at (0, 0, z)
gravity (0, 0, -1)
potential 3*(z + 2)^2/2 + theta*z/10
continue equilibria in Omega = 0..3
EOF
qdot --json wells.lag | grep -c '"type":"degenerate"'
qdot --json wells.lag | grep -c '"type":"fold"'
