# What `continue orbit` refuses, each at its place.
scene='coord x; param m, k, mu, w, F; particle p mass m at x; potential k*x^2/2 + x^4/4; set m = 1, k = 2, mu = 1, w = 1, F = 1; start x = 1'
while read -r line; do
    qdot -q -e "$scene" -e "$line" 2>&1 | grep -v '^  [a-z1]*  *\|^run' || echo "exit $?"
done <<'END'
continue orbit
continue orbit in
continue orbit in mu
continue orbit in mu = 1..1
continue orbit in nu = 0..1
continue orbit in k = 1..3
run 0..1; continue orbit in k = 1..3
find T = 4 such that returns after T; continue orbit in k = 3..4
find T = 4 such that returns after T; continue orbit in energy = 100..200
find T = 4 such that returns after T; continue orbit in mu = 0..1 as m
start x = 0; run 0..1; continue orbit in k = 1..3
force -mu*x' + F*cos(w*t) on p; find x = 1, x' = 0 such that returns after 2*pi/w; continue orbit in x = 0..1
force -mu*x' + F*cos(w*t) + F*cos(k*t) on p; find x = 1, x' = 0 such that returns after 2*pi/w; continue orbit in w = 0.5..1
force -mu*x' + F*exp(-t) on p; start x = 0; set F = 0; run 0..1; continue orbit in F = 0..1
coord y; particle q mass m at y; potential y^2; find T = 4.44 such that returns after T; continue orbit in m = 1..2
END
