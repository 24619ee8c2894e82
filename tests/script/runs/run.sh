# Runs from their values to their numbers; of their reports only the first line.
qdot -q - <<'END' | sed '/^  /d'
param m, l > 0, g
coord theta
particle bob mass m at (l*sin(theta), -l*cos(theta))
gravity (0, -g)
set m = 1, l = 1, g = 9.81
start theta = 2
run 0..10 tol 1e-12 method rk8pd as a
check value(theta, 0) == 2 within 1e-15
check value(energy, 10) == value(energy, 0) within 1e-10
check value(a.theta', 0) == 0 within 1e-15
start a
run 10..0 method rk8pd as back
check value(theta, 0) == 2 within 1e-8
run 0..1 with g = 0, theta = 2, theta' = 3 method rk8pd as free
check value(free.theta, 1) == 5 within 1e-11
check not value(free.theta, 1) == 6 within 1e-6
w = value(theta, 1)
check w - 5 == 0 within 1e-11
run 0..1 method rkf45 tol 1e-9
END
