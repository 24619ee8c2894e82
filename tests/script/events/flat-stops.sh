# A method that cannot cross a flat place stops before it while its steps are still some: of an N-four-bar
# with N = 2, rk8pd; the message says which constraints, and what can go on.
qdot -q --json - <<'END' 2>/dev/null | awk '/"kind":"run"/ {
    match($0, /"steps":[0-9]*/); if (substr($0, RSTART + 8, RLENGTH - 8) + 0 > 1000) print "too many:", $0
    if ($0 !~ /"status":"failed"/ || $0 !~ /steps came down to/) print "what is this:", $0
    if ($0 !~ /which method taylor can go over/) print "no way out:", $0; runs++ } END { print runs }'
coord x[i], y[i], theta[i] for i = 0..2
coord u[i], v[i], phi[i] for i = 1..2
body bar[i] mass 1 inertia 1/12 at (x[i], y[i]) angle theta[i] for i = 0..2
body top[i] mass 1 inertia 1/12 at (u[i], v[i]) angle phi[i] for i = 1..2
gravity (0, -9.81)
constraint ground[i]: point(bar[i], (0, -1/2)) = (i, 0) for i = 0..2
constraint left[i]: point(top[i], (-1/2, 0)) = point(bar[i-1], (0, 1/2)) for i = 1..2
constraint right[i]: point(top[i], (1/2, 0)) = point(bar[i], (0, 1/2)) for i = 1..2
start x[i] = i, y[i] = 1/2, theta[i] = 0, x[i]' = 1/2, theta[i]' = -1 for i = 0..2
start u[i] = i - 1/2, v[i] = 1, phi[i] = 0, u[i]' = 1 for i = 1..2
run 0..10 method rk8pd
END

# N = 10: what is read between the steps about a flat place takes no steps of its own; and steps that are
# short all the way, to a tight tolerance, are no sign of such a place.
wide() {
    qdot -q - <<END 2>&1 | sed -n 's/^notice:.* about t = \(.*\);.*/over \1/p
s/^run1:.*, done/done/p; s/^run1:.*stopped at t = \([0-9]\.[0-9]\).*: steps came down.*/stopped at \1/p'
coord x[i], y[i], theta[i] for i = 0..10
coord u[i], v[i], phi[i] for i = 1..10
body bar[i] mass 1 inertia 1/12 at (x[i], y[i]) angle theta[i] for i = 0..10
body top[i] mass 1 inertia 1/12 at (u[i], v[i]) angle phi[i] for i = 1..10
gravity (0, -9.81)
constraint ground[i]: point(bar[i], (0, -1/2)) = (i, 0) for i = 0..10
constraint left[i]: point(top[i], (-1/2, 0)) = point(bar[i-1], (0, 1/2)) for i = 1..10
constraint right[i]: point(top[i], (1/2, 0)) = point(bar[i], (0, 1/2)) for i = 1..10
start x[i] = i, y[i] = 1/2, theta[i] = 0, x[i]' = 1/2, theta[i]' = -1 for i = 0..10
start u[i] = i - 1/2, v[i] = 1, phi[i] = 0, u[i]' = 1 for i = 1..10
run $1
END
}
wide '0..4 tol 1e-5 method rk8pd'
wide '0..2 tol 1e-12 method rkf45'
