# The values of one run against those of another: on the curve that both make.
qdot -q -e 'coord x, y; particle p mass 1 at (x, y); potential (x^2 + y^2)/2; start x = 1, y'"'"' = 1' \
    -e 'run 0..2*pi as a; run 0..2*pi with x = 2, y = 1/2 as b' \
    -e 'plot a.x vs b.y to "ab.svg" keep' | tail -n 1
# a.x = cos(t), b.y = cos(t)/2 + sin(t)
awk '/^[-0-9]/ { d = ($1 - $2/2)^2 + $2^2 - 1; d = d < 0 ? -d : d; if (d > most) most = d; n++ }
    END { print (n > 50 ? "many points" : n), (most < 1e-12 ? "on the curve" : most) }' ab.dat
qdot -q -e 'coord x; particle p mass 1 at x; start x = 1; run 0..1 tol 1e-9 as a' -e 'show a' | tail -n 1
