# Events of scenes with coordinates without mass: behind `then` their velocities, and of z without damping its place, follow
# from their equations. Slopes against differences of SciPy's runs (solve_ivp, rtol 1e-13) of both.
qdot -q - <<END 2>&1 | grep '^d(\|^hit\|error:' | sed 's/ ± .*//; s/\([0-9]\.[0-9]\{8\}\)[0-9]*/\1/'
param c = 0.9, k = 1.5, e = 0.7
coord x, z, y
particle a mass 1 at y
dissipation c*(x' - y')^2/2
potential k*x^2/2 + y^2/2 + (z - x)^2 + (z - y)^2
event hit: y = -0.1 falling then y' = -e*y', x = x + 0.2*x'
start x = 1, y = 0.5
run 0..8 tol 1e-14
hit[2]
sensitivity value(x', 8) of x, y, c, k, e
sensitivity value(z', 8) of x, y, c, k, e
sensitivity hit[2] of x, y, c, k, e
END
# An equation that is not linear in what it has to determine, and one that the event does not change.
for then in "y = y + 0.1" "y' = -y'/2"; do
    qdot -q - <<END 2>&1 | grep '^d(\|error:' | sed 's/ ± .*//; s/\([0-9]\.[0-9]\{8\}\)[0-9]*/\1/'
coord x, y
particle a mass 1 at y
potential x^4/4 + x^2/2 - x*y + y^2
event hit: y' = 0 rising then $then
event cross: y = 0 falling then y' = y'/2
start y = 0.5, y' = 0.1
run 0..8 tol 1e-14
sensitivity value(x, 8) of y
END
done
