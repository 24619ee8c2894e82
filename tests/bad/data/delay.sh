# Where x(t - tau) may not stand, what is no delay, and what is not built with one.
while read -r line; do
    qdot -q -e "param tau; coord x, y; particle p mass 1 at (x, y); start x = 0; $line" 2>&1
    echo "exit $?"
done <<'EOF2'
force (x(t - x), 0) on p
force (x(t/2), 0) on p
force (x''(t - 0.1), 0) on p
force (x(t), 0) on p
potential x*y(t - 1)
dissipation x'^2*y(t - 1)
gravity (0, x(t - 1))
constraint x = y(t - 1)
spring between (x(t - 1), 0), p stiffness 1
spring between (0, 0), p stiffness 1 rest x(t - 1)
particle q mass 1 at (x(t - 1), 0)
particle q mass y(t - 1) at (x, 0)
body b mass 1 inertia 1 at (x, y) angle x(t - 1)
output x(t - 1)
force (x(t + 0.1), 0) on p; run 0..1
force (x(t - tau), 0) on p; run 0..1
force (x(t - tau), 0) on p; set tau = -1; run 0..1
force (x(t - tau), 0) on p; set tau = 1; event e: x = 1 then tau = 2; run 0..1
force (x(t - 0.1), 0) on p; run 1..0
force (x(t - 0.1), 0) on p; run 0..1 method dop853
force (x(t - 0.1), 0) on p; run 0..1 digits 20
event e: x(t - 0.1) = 1; run 0..1 method rk8pd
force (x(t - 0.1), 0) on p; equilibria
force (x(t - 0.1), 0) on p; modes
force (x(t - 0.1), 0) on p; linearize at equilibria[1]
force (x(t - 0.1), 0) on p; lyapunov 0..10
force (x(t - tau), 0) on p; find tau = 1..2 such that value(x, 3) = 0
force (x(t - 0.1), 0) on p; export c eom to "eom.c"
state z' = z(t - 0.1); equilibria
force (x(t - 0.1), 0) on p; run 0..1 as a; start a
force (x(t - 0.1), 0) on p; run 0..1 as a; value(a.x(t + 0.1), 0.95)
force (-sign(x(t - 1)), 0) on p; start x' = 1; run 0..3
EOF2
qdot -q -e "coord x; lagrangian x'^2/2 - x*x(t - 1)" 2>&1
echo "exit $?"
