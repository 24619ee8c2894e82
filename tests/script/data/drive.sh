# Functions given by tables: what they are, runs over their knots, and what follows a session about.
# Independent numbers: SciPy's CubicSpline (not-a-knot, periodic), numpy.interp and DOP853 from knot to knot.
printf 't,F\n0,1\n1,0.5\n1.5,-1\n3,0.25\n4,2\n6,-0.5\n8,0\n' >drive.csv
scene='coord x; particle p mass 2 at x; potential 3*x^2/2; start x = 1'
qdot -q - <<'EOF2' 2>&1
coord x
particle p mass 2 at x
potential 3*x^2/2
data drive from "drive.csv" : t, F
data ramp from "drive.csv" : t, F linear
data stairs from "drive.csv" : t, F steps
data again from "drive.csv" : t*1e-3, 10*F - 1 hold
drive
numeric(drive(2)); numeric(drive'(2)); numeric(ramp(2)); numeric(ramp'(2)); numeric(stairs(2)); numeric(stairs(8))
numeric(again(0.002)); numeric(again(-1)); numeric(again(5))
numeric(2*drive(t))
diff(drive(t)^2, t)
force drive(t) + ramp(t/2) + stairs(t) on p
eom
start x = 1
check drive(2) == -1.398867949221306 within 1e-15
check drive'(2) == 0.3456026698076169 within 1e-15
run 0..8 as a
check value(x, 8) == -3.1419301107856983 within 1e-13
check value(x', 8) == -3.626204189826518 within 1e-13
run 0..8 method dop853
run 0..8 method radau
start a
run 8..0
check value(x, 0) == 1 within 1e-12
EOF2
# a period, also behind and before the table; values, extrema and means go over the knots
printf 'phi,r\n0,1\n1,2\n2.5,0\n4,1\n' >cam.csv
qdot -q -e "$scene" -e 'function phi(t); data cam from "cam.csv" : phi, r periodic; force cam(t) on p; numeric(cam(6.5)); numeric(cam(-1.5)); run 0..20; check value(x, 20) == 0.4373225814269309 within 1e-13; check max(cam(t), 0..20) == 2.00497785823 within 1e-11; check mean(cam(t), 0..4) == 0.8928571428571429 within 1e-14; max(cam(t), 0..20); mean(cam(t), 0..4); value(cam(t), 10.5)'
# a force that depends on the place: steps end where the motion passes a knot
printf 'x,F\n-3,8\n-2,2.2\n-1,0.9\n0,0\n0.5,-0.6\n1,-1.1\n2,-1.8\n3,-9\n' >force.csv
qdot -q -e 'coord x; particle p mass 1 at x; data F from "force.csv" : x, F; force F(x) on p; start x = 2.5; run 0..10; check value(x, 10) == 0.2631999046969 within 1e-12; sensitivity value(x, 3) of x'
# two arguments on a grid
awk 'BEGIN { print "alpha,v,c"; for (i = 0; i < 4; i++) for (j = 0; j < 5; j++) print i/2 "," j "," i*i*j/8 - j*j*j/10 }' >lift.csv
qdot -q -e 'data lift from "lift.csv" : alpha, v, c; data flat from "lift.csv" : v, alpha, c linear hold; lift; numeric(lift(0.7, 2.5)); check lift(0.7, 2.5) == -0.95 within 1e-14; numeric(diff(lift(alpha, v), alpha)); numeric(flat(2.5, 0.7)); numeric(flat(9, 0.7))'
qdot -q -e 'coord x, y; particle p mass 1 at (x, y); data lift from "lift.csv" : alpha, v, c hold; force (0, lift(x, y)) on p; gravity (0, -1); start x = 0.1, y = 1, x'"'"' = 0.2; run 0..3'
# gaps are counted; the statement is written, undone and forgotten
printf 't,F\n0,1\n1,nan\n2,3\n\n3,\n4,0\n' >gaps.csv
qdot -q -e 'data g from "gaps.csv" : t, F; numeric(g(3))' -e 'scene to "out.lag"' && cat out.lag
qdot -q -e 'data g from "gaps.csv" : t, F' -e 'undo' -e 'g' 2>&1
qdot -q -e 'data g from "gaps.csv" : t, F' -e 'reset' -e 'param g = 3' -e 'g' 2>&1
# what holds for any function is proved; what does not is not refuted by values that the data do not have
qdot -q -e 'data drive from "drive.csv" : t, F; param x; check drive(x) + 1 > drive(x); check drive(0) > 0; check drive(0) == 2; check drive(0) > 0 within 0; check drive(0) == 1 within 1e-15' 2>&1
# far from t = 0 a run counts from its start; the function reads the same places
printf 't,F\n9999,1\n10000,2\n10001,0\n10002,1\n' >far.csv
qdot -q -e 'coord x; particle p mass 1 at x; data f from "far.csv" : t, F linear hold; force f(t) on p; start x = 0; run 10000..10001; check value(x, 10001) == 2/3 within 1e-14' -e 'reset' -e 'coord x; particle p mass 1 at x; function f(t); set f(t) = 10001 - t; force f(t) on p; start x = 0; run 10000..10001; check value(x, 10001) == 1/3 within 1e-12'
