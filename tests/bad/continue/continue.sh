# What `continue` refuses, each at its place.
scene='coord x; param m, k, mu; particle p mass m at x; potential k*x^2/2 - mu*x; set m = 1, k = 2, mu = 1'
while read -r line; do
    qdot -q -e "$scene" -e "$line" 2>&1 || echo "exit $?"
done <<'EOF'
continue
continue orbits in mu = 0..1
continue equilibria
continue equilibria in
continue equilibria in nu = 0..1
continue equilibria in x = 0..1
continue equilibria in mu
continue equilibria in mu = 1
continue equilibria in mu = 1..1
continue equilibria in mu = 0..q
continue equilibria in mu = 0..1/0
continue equilibria in mu = 0..1 as m
continue equilibria in mu = 0..1 step 2
param nu; continue equilibria in nu = 0..1
param nu > 0; continue equilibria in nu = -1..1
param w; potential w*x^4; continue equilibria in mu = 0..1
potential -x^2; set mu = 1; continue equilibria in mu = 1/2..2
remove potential; potential exp(mu*x); continue equilibria in mu = 1..2
remove potential; continue equilibria in m = 1..2
potential sin(t)*x^2; continue equilibria in mu = 0..1
param c; remove potential; potential x^3/3 + (c^2 + 1)*x; continue equilibria in c = -1..1
coord y; particle q mass m at y; constraint knife: y' = x*x'; continue equilibria in mu = 0..1
plot
EOF
qdot -q -e 'param mu; continue equilibria in mu = 0..1' 2>&1 || echo "exit $?"
