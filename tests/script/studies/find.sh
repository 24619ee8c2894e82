# Unknowns for which conditions on a run hold, against closed forms and independent calculations.
cat >pendulum.lag <<'END'
param m, L, g > 0
coord theta
particle b mass m at (L*sin(theta), -L*cos(theta))
gravity (0, -g)
set m = 1, L = 1, g = 9.81
start theta = 2
END
# a boundary value; the value found holds afterwards, the run is the latest, undo takes it back
qdot -q pendulum.lag - <<'END' 2>&1
find theta' = 0..5 such that value(theta, 3) = 0
check value(theta, 3) == 0 within 1e-13
run 0..3
check value(theta, 3) == 0 within 1e-13
undo
undo
find theta' = 0..5 such that value(theta, 3) = 0 run 0..4 tol 1e-10 as far
check value(far.theta, 3) == 0 within 1e-10
END
# a period: 4 sqrt(L/g) K(sin 1), a time of the statement's own; a parameter keeps it
qdot -q pendulum.lag - <<'END' 2>&1
find T = 3 such that returns after T
check value(theta, 0) == 2 within 1e-15
param P
find P = 2 such that returns after P, value(theta', P/2) = 0
check value(P, 0) == 2.66587094283492593 within 1e-12
# one unknown more than conditions: the mass point that swings with a period of 3
start theta' = 0
find L = 1, theta = 1, T = 3 such that returns after T and T = 3 and theta = 1.1 as s
check value(s.theta, 3) == 1.1 within 1e-12
check value(L, 0) == 1.91266864518707329 within 1e-12
END
# parameters and events; several conditions; the run of the latest options; constants of other runs
cat >ball.lag <<'END'
param g = 10, e = 0.5
coord x, y
particle b mass 1 at (x, y)
gravity (0, -g)
event bounce: y = 0 falling then y' = -e*y'
start y = 1, x' = 0.3
END
qdot -q ball.lag - <<'END' 2>&1 | grep -v '^  '
# a flight of v^2/(2g) from y = 5/4: first fall .5 s, bounce at half the speed, .5 s up and down
find y = 0.9..2 such that bounce[1] = 1/2 run 0..1
find e = 0.3, x' = 1 such that bounce[2] = 1 and value(x, bounce[2]) = 2 run 0..2 as a
check value(y, 0) == 1.25 within 1e-13
check value(e, 0) == 0.5 within 1e-13
check value(x', 0) == 2 within 1e-13
find g = 8 such that value(y, 0.3) = value(a.y, 0.3) + 0.09
check value(g, 0) == 8 within 1e-12
END
# constraints: the start follows the unknown
qdot -q - <<'END' 2>&1
coord x, y
particle b mass 1 at (x, y)
constraint rod: x^2 + y^2 = 1
gravity (0, -9.81)
start x = sin(2), y = -cos(2)
find T = 2.6 such that returns after T
find x' = -1..1 such that value(x, 1/2) = 0.6
check value(x, 1/2) == 0.6 within 1e-13
END
# between bounds what has no slopes is found too
qdot -q - <<'END' 2>&1
param k = 1
coord x
particle b mass 1 at x
force (-k*sign(x)) on b
start x = 1
find k = 0.1..0.4 such that value(x', 2) = -0.5
check value(k, 0) == 0.25 within 1e-12
END
# numbers of JSON
qdot -q --json pendulum.lag -e "find theta' = 0..5 such that value(theta, 3) = 0" | sed 's/\([0-9]\.[0-9]\{11\}\)[0-9]*/\1/; s/"error":[0-9]e-1[0-9.]*/"error":small/'

# on a rod: y follows x, below; SciPy by the angle: -0.5008993626206685. An x that no point of the rod has is none
qdot -q - <<'END' 2>&1 | sed 's/= [-0-9.e]* ± [0-9.e-]*/= N ± ERROR/' | grep -v '^  '
coord x, y
particle p mass 1 at (x, y)
gravity (0, -9.81)
constraint rod: x^2 + y^2 = 1
start x = 0.8, y = -0.6, x' = 0, y' = 0
find x = 0.9 such that value(x, 1) = 0.5
check value(x, 0) == -0.500899362620668 within 1e-12
run 0..1 as again
check value(again.x, 1) == 0.5 within 1e-12
find x' = 1 such that value(x, 1) = 0.4
check value(x*x' + y*y', 0) == 0 within 1e-13
find x = 1.5 such that value(x, 1) = 0.5
END
qdot -q - <<'END' 2>&1 | grep 'error\|hint'
coord x, y, u, v
particle p mass 1 at (x, y)
particle q mass 1 at (u, v)
constraint rod: x^2 + y^2 = 1
constraint arm: (u - x)^2 + (v - y)^2 = 1
start x = 0.8, y = -0.6, u = 0.8, v = -1.6
find x = 0.7 such that value(u, 1) = 0.5
END
# after a run with digits
qdot -q pendulum.lag -e "run 0..1 digits 20" -e "find theta' = 2 such that value(theta, 3) = 0" 2>&1 | grep 'a double'
