# Fits to data whose answer is known: values, standard errors, weights, forms of files, undo.
# Numbers of --json, to five digits: value, then error (0 where it is rounding)
numbers()
{
    sed '/covariance/s/\(\.[0-9]\{7\}\)[0-9]*/\1/g' | awk -F'"value":|,"error":|,"statement":' '/"kind":"number",/ { split($0, name, "\"")
        error = $3 + 0 < 1e-9 ? 0 : $3
        printf "%s = %.5g, error %s\n", name[8], $2, $3 == "null" ? $3 : sprintf("%.4g", error) }
        !/"kind":"number",/'
}
cat >oscillator.lag <<'EOF'
param m, k > 0
coord x
particle p mass m at x
potential k*x^2/2
EOF
# exact data give the values back
qdot -q oscillator.lag -e 'set m = 2, k = 9; start x = 1, x'"'"' = 0.5; run 0..5; table x, m*x'"'"' every 0.25 to "exact.csv"' | tail -n 1
qdot -q --json oscillator.lag -e 'set m = 2, k = 8; start x = 0.8; fit k, x, x'"'"' to "exact.csv" : t, x, skip' |
    grep -v 'chi^2\|covariance' | numbers
# by the momentum: m, k and the start are determined up to a factor; by x alone, m and k are
qdot -q oscillator.lag - <<'EOF' 2>&1
set m = 1.8, k = 8
start x = 0.8
fit m, k, x, x' to "exact.csv" : t, skip, m*x' as rest
EOF
qdot -q oscillator.lag -e 'set m = 1.8, k = 8; start x = 0.8; fit m, k, x, x'"'"' to "exact.csv" : t, x, skip' 2>&1
qdot -q --json oscillator.lag -e 'set m = 1.8, k = 8; start x = 0.8; fit m, k, x, x'"'"' to "exact.csv" : t, x, m*x'"'" |
    grep -v 'chi^2\|covariance' | numbers
# a straight line, x = a + v t, as by the formulas of regression (NumPy: polyfit)
cat >line.csv <<'EOF'
t;x;s
0;1.1;0.1
1;1.9;0.1

2;3.2;0.2 # read twice
4;5.05;0.2
2;2.9;0.2
EOF
line='coord x; particle p mass 1 at x'
qdot -q --json -e "$line" -e 'fit x, x'"'"' to "line.csv" : t, x, skip' | grep -v covariance | numbers
qdot -q --json -e "$line" -e 'fit x, x'"'"' to "line.csv" : t, x, sigma' | numbers
qdot -q -e "$line" -e 'fit x, x'"'"' to "line.csv" : t, x, sigma; table residuals; undo; run 0..1' |
    sed '/^run1/,/end state/d'
# numbers enough for values alone; a start elsewhere; CRLF, blanks
printf '10 3\r\n12 5\r\n' >two.txt
qdot -q -e "$line" -e 'fit x, x'"'"' to "two.txt" : t, x from 10'
qdot -q -e "$line" -e 'fit x, x'"'"' to "two.txt" : t, x sigma 0.5 from 10 as few; plot few to "few.svg"; save few to "few.csv"' |
    tail -n 3
cat few.csv
# another value and a start that follow an unknown; two columns with errors of their own
cat >follow.lag <<'EOF'
param l > 0, g, w
coord theta
particle b mass 1 at (l*sin(theta), -l*cos(theta))
gravity (0, -g)
set g = w^2*l, l = 1
start theta = w/4
EOF
qdot -q follow.lag -e 'set w = 3.2; run 0..3; table theta, energy every 0.1 to "follow.csv"' | tail -n 1
qdot -q --json follow.lag -e 'set w = 3; fit w to "follow.csv" : t, theta, energy sigma 0.01, 0.1' | grep -v covariance | numbers
qdot -q follow.lag -e 'set w = 3; fit w to "follow.csv" : t, theta, energy sigma 0.01, 0.1; print numeric(g, 6)' | tail -n 1
# constraints; a bounce
cat >rod.lag <<'EOF'
param l, g = 9.81
coord x, y
particle b mass 1 at (x, y)
gravity (0, -g)
constraint rod: y = -sqrt(l^2 - x^2)
start x = 0.6
EOF
qdot -q rod.lag -e 'set l = 1; run 0..2; table x every 0.2 to "rod.csv"' | tail -n 1
qdot -q --json rod.lag -e 'set l = 1.1; fit l, x to "rod.csv" : t, x sigma 0.01' | grep -v 'chi\|cov' | numbers
cat >ball.lag <<'EOF'
param e, g = 10
coord y
particle b mass 1 at (0, y)
gravity (0, -g)
event bounce: y = 0 falling then y' = -e*y'
start y = 1
EOF
qdot -q ball.lag -e 'set e = 0.7; run 0..1; table y every 0.05 to "ball.csv"' | tail -n 1
qdot -q --json ball.lag -e 'set e = 0.75; start y = 1.05; fit e, y to "ball.csv" : t, y sigma 0.01' | grep -v 'chi\|cov' | numbers
# a stiff scene, by radau
cat >stiff.lag <<'EOF'
param c = 1000, k
coord x
particle b mass 1 at x
potential k*x^2/2
dissipation c*x'^2/2
start x = 1
EOF
qdot -q stiff.lag -e 'set k = 900; run 0..4 method radau; table x every 0.25 to "stiff.csv"' | tail -n 1
qdot -q --json stiff.lag -e 'set k = 700; fit k to "stiff.csv" : t, x method radau tol 1e-10' | grep -v 'chi\|cov\|notice' | numbers
# runs that are less exact than the data
qdot -q oscillator.lag -e 'set m = 2, k = 8.9; start x = 1; fit k, x, x'"'"' to "exact.csv" : t, x, skip sigma 1e-9 method radau tol 1e-3' |
    sed -n '/^notice/s/may be.*/.../p'
# larger than sigma
qdot -q -e "$line" -e 'fit x, x'"'"' to "line.csv" : t, x, skip sigma 0.01' | tail -n 1
# what is set can be saved and read again
qdot -q -e "$line" -e 'fit x, x'"'"' to "line.csv" : t, x, sigma; scene to "found.lag"' >found.txt
grep start found.lag
