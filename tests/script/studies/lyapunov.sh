# Lyapunov exponents against values found by another program (Runge-Kutta of order 4, variational equations by
# differences of the accelerations, over 1e5, 4e3 and 2e4 units of time), within the errors stated.
near='{ match($0, /"value":[-0-9.e]*/); v = substr($0, RSTART + 8, RLENGTH - 8) + 0
        match($0, /"error":[-0-9.e]*/); e = substr($0, RSTART + 8, RLENGTH - 8) + 0
        match($0, /"name":"[^"]*"/); d = v - want[NR] < 0 ? want[NR] - v : v - want[NR]
        print substr($0, RSTART, RLENGTH), d <= e + slack && e < most ? "agrees" : "is " v " within " e }'
cat >henon-heiles.lag <<'END'
coord x, y
lagrangian (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y + y^3/3
start x = 0, y = -0.15, x' = sqrt(2*(1/6 - 0.15^2/2 - 0.15^3/3))
END
cat >double.lag <<'END'
coord theta1, theta2
r1 = (sin(theta1), -cos(theta1))
particle a mass 1 at r1
particle b mass 1 at r1 + (sin(theta2), -cos(theta2))
gravity (0, -9.81)
start theta1 = 2, theta2 = 2
END
cat >driven.lag <<'END'
coord theta
particle p mass 1 at (sin(theta), -cos(theta))
gravity (0, -1)
torque -theta'/2 + 1.15*cos(2*t/3) on theta
start theta = 0.5
END
# a regular motion has none: 0 within its error
qdot -q --json -e 'include "henon-heiles.lag"; start y = 0.01, x'"'"' = 0.1; lyapunov 0..2000' |
    awk -v most=0.01 'BEGIN { want[1] = 0 } '"$near"
qdot -q --json -e 'include "henon-heiles.lag"; lyapunov 0..2e4' |
    awk -v most=0.1 -v slack=0.01 'BEGIN { want[1] = 0.127 } '"$near"
qdot -q --json -e 'include "double.lag"; lyapunov spectrum 0..500' |
    awk -v most=0.5 -v slack=0.05 'BEGIN { want[1] = 1.35; want[4] = -1.35 } '"$near"
qdot -q --json -e 'include "driven.lag"; lyapunov spectrum 0..4000' |
    awk -v most=0.1 -v slack=0.005 'BEGIN { want[1] = 0.099; want[2] = -0.599 } '"$near"
# the double pendulum in Cartesian coordinates, under constraints: directions are those on them
cat >rods.lag <<'END'
coord x1, y1, x2, y2
particle a mass 1 at (x1, y1)
particle b mass 1 at (x2, y2)
constraint rod1: x1^2 + y1^2 = 1
constraint rod2: (x2 - x1)^2 + (y2 - y1)^2 = 1
gravity (0, -9.81)
start x1 = 0.96, y1 = 0.28, x2 = 1.92, y2 = 0.56
END
qdot -q --json -e 'include "rods.lag"; lyapunov 0..300' |
    awk -v most=0.8 -v slack=0.1 'BEGIN { want[1] = 1.35 } '"$near"
# how it settled
qdot -q -e 'coord x; lagrangian x'"'"'^2/2 + x^2/2; lyapunov spectrum 0..60 to "saddle.csv"' 2>&1 | sed 's/±.*//'
sed -n '1p;$p' saddle.csv | sed 's/\(\.[0-9]\{2\}\)[0-9]*/\1/g'; wc -l <saddle.csv
# in every kind of file; the numbers are those of the .csv
qdot -q -e 'coord x; lagrangian x'"'"'^2/2 + x^2/2; lyapunov 0..60 to "one.csv"; lyapunov 0..60 to "one.json"' \
    -e 'lyapunov 0..60 to "one.html"; lyapunov 0..60 to "one.txt"' >/dev/null
sed -n 1p one.txt; sed -n '/columns/p' one.json; grep -c '<tr>' one.html
sed -n '/rows/,$p' one.json | sed -n '2,$p' | tr -d '[]}' >rows
sed '1d' one.csv | paste -d , - rows |
    awk -F, '$1 + 0 == $3 + 0 && $2 + 0 == $4 + 0 { n++ } END { print n == NR ? "the same numbers" : "other numbers" }'
