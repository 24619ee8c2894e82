# Ends of runs at tol 1e-15 against 34 digits: what is left is the rounding of what is printed,
# though each of these scenes makes ten to ten thousand times more of a rounding. And statements
# that are right: the error is not above three times what is stated.
scene()
{
    name=$1 t0=$2 t1=$3
    text=$(cat)
    states=$({ echo "$text"; echo "run $t0..$t0"; } | qdot -q --json - |
        sed -n 's/.*"state":{\([^}]*\)}.*/\1/p' | tr ',' '\n' | sed 's/"//g; s/:.*//')
    {
        echo "$text"
        echo "run $t0..$t1 digits 34 as right"
        echo "run $t0..$t1 tol 1e-15 as two"
        for x in $states; do
            for t in "$t1" "($t0 + 2*($t1))/3"; do
                echo "d = value(two.$x, $t) - value(right.$x, $t)"
                echo "print \"off\", d, value(right.$x, $t)"
            done
        done
    } | qdot -q - | awk -v name="$name" '
        $1 == "off" {
            off = $2 < 0 ? -$2 : $2
            size = $3 < 0 ? -$3 : $3
            off /= size > 1 ? size : 1
            if (off > most) most = off
            n++
        }
        /error of the end state/ { stated = $NF + 0 }
        END {
            if (n == 0 || most > 8 * 2^-53)
                printf "%s: off by %.3g at %d places\n", name, most, n
            else if (!(stated > 0 && stated < 1e-14))
                printf "%s: states %g\n", name, stated
            else
                print name ": right to the last digit"
        }'
}

scene 'double pendulum' 0 6 <<'EOF'
param m1 = 1, m2 = 0.3, L1 = 1, L2 = 0.7, g = 9.81
coord a, b
r1 = (L1*sin(a), -L1*cos(a))
r2 = r1 + (L2*sin(b), -L2*cos(b))
particle p mass m1 at r1
particle q mass m2 at r2
gravity (0, -g)
start a = 2, b = 2.1
EOF

scene 'ellipse, its momentum kept' 0 30 <<'EOF'
coord r > 0, phi
particle p mass 1 at (r*cos(phi), r*sin(phi))
potential -1/r
start r = 0.3, phi' = sqrt(1.7)/0.3
EOF

scene 'driven, from a time that is no double' 0.1 20.3 <<'EOF'
param w = 1.7, A = 0.3
coord x
particle p mass 1 at (x, 0)
potential x^4/4 - x^2/2
force (A*cos(w*t), 0) at p
start x = 1.1
EOF

scene 'constant masses, coupled' 0 40 <<'EOF'
param k = 0.7, l = 0.1
coord x, y
particle p mass 1.1 at (x, 0)
particle q mass 0.3 at (x + y, 0)
potential k*x^2/2 + y^4/4 + l*exp(x)
start x = 1.1, y = 0.4
EOF

scene 'functions of every kind' 0 12 <<'EOF'
coord x, y
particle p mass 1 at (x, y)
potential cosh(x) + atan(y)^2 + sqrt(1 + x^2*y^2) + log(2 + y^2) + (1.3 + x^2)^0.7
start x = 0.7, y = 0.4, x' = 0.3
EOF

scene 'parts that go apart' 0 9 <<'EOF'
coord x, y
particle p mass 1 at (x, y)
potential 7*x^2/2 + x^4 + 900*y^2/2 + y^4/3
start x = 1.1, y = 0.3
EOF

scene 'a stated Lagrangian' 0 15 <<'EOF'
coord x, y
lagrangian x'*y' + 0.3*x*y' - x*y - x^2*y/10
start x = 0.7, y' = 0.3
EOF

scene 'stiff spring' 0 2 <<'EOF'
coord r > 0, a
particle p mass 1 at (r*sin(a), -r*cos(a))
gravity (0, -9.81)
potential 1e4*(r - 1)^2/2
start r = 1.001, a = 1
EOF

scene 'chain' 0 4 <<'EOF'
N = 4
coord a[k] for k = 1..N
particle bob[k] mass 0.7 at (sum(sin(a[j]), j, 1, k), -sum(cos(a[j]), j, 1, k)) for k = 1..N
gravity (0, -9.81)
start a[k] = pi/2 for k = 1..N
EOF

scene 'chain by its residual, damped' 0 3 <<'EOF'
N = 7
coord a[k] for k = 1..N
particle bob[k] mass 0.7 at (sum(sin(a[j]), j, 1, k), -sum(cos(a[j]), j, 1, k)) for k = 1..N
gravity (0, -9.81)
dissipation sum(0.05*a[k]'^2, k, 1, N)
start a[k] = pi/2 for k = 1..N
EOF
