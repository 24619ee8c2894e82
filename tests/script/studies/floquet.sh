# Multipliers of periodic orbits, against closed forms.
cat >kapitza.lag <<'END'
param Om = 20
coord theta
particle b mass 1 at (sin(theta), cos(Om*t)/10 - cos(theta))
gravity (0, -10)
start theta = pi
END
value='s/"error":[0-9.e-]*/"error":small/; s/\([0-9]\.[0-9]\{10\}\)[0-9]*/\1/g'
# upright: two real ones whose product is 1; a pair on the circle where it shakes faster
qdot -q --json kapitza.lag - <<'END' 2>&1 | grep -v '"run"' | sed "$value"
run 0..2*pi/Om
floquet
set Om = 50
run 0..2*pi/Om
floquet
END
# damped and driven: their product is exp(-0.2 T)
qdot -q --json - <<'END' 2>&1 | sed "$value"
coord x
lagrangian x'^2/2 - x^2/2 - x^4/4
dissipation 0.1*x'^2
force 0.3*cos(1.3*t) on x
find x = 0.5, x' = 1 such that returns after 2*pi/1.3
floquet
END
# on a sphere: the conical pendulum at cos = 4/5 has exp(i w T), w^2/Omega^2 = 1 + 3 cos^2
qdot -q --json - <<'END' 2>&1 | sed "$value"
coord x, y, z
particle b mass 1 at (x, y, z)
constraint s: x^2 + y^2 + z^2 = 1
gravity (0, 0, -9.81)
start x = 0.6, y = 0, z = -0.8, x' = 0
find y' = 2, T = 1.8 such that returns after T
floquet
END
# an orbit that shrinks to nothing is none; a rest is told, be it found as 0 or as 1e-164
qdot -q - <<'END' 2>&1 | sed "s/^\(x'*\) = .*e-1[0-9][0-9]$/\1 = 0/"
coord x
lagrangian x'^2/2 - x^2/2
start x = 1
run 0..2*pi as round
run 0..1
floquet
find x = 0.1, x' = 0 such that returns after 1
start x = 1
find T = -6 such that returns after T
floquet
END
qdot -q - <<'END' 2>&1 | grep equilibrium
coord x
lagrangian x'^2/2 - x^2/6
find x = 0.3, x' = 0 such that returns after 1
END
# a pendulum near its top beside a free motion: all multipliers are 1, found in pairs that errors of slopes split; not unstable
qdot -q - <<'END' 2>&1 | grep -c 'run1: unstable'
coord th, z
lagrangian th'^2/2 + cos(th) + z'^2/2
start th = 3.1
find T = 16 such that returns after T
floquet
END
# on top of a sphere that a drive shakes, under a constraint: two equal pairs whose product is 1
qdot -q --json - <<'END' 2>&1 | grep -v '"run"' | sed 's/"error":[0-9.e-]*/"error":small/; s/\([0-9]\.[0-9]\{8\}\)[0-9]*/\1/g'
coord x, y, z
particle b mass 1 at (x, y, z)
constraint s: x^2 + y^2 + z^2 = 1
gravity (0, 0, -9.81)
force (0, 0, 2*cos(3*t)) on b
start x = 0, y = 0, z = 1
run 0..2*pi/3
floquet
END
# multipliers 1 in pairs with one vector behind impacts: a ball, by its height or its time alone; a square in a circle; never
# surely beyond the circle, nor one of a complex pair alone. A wall and a kick at the floor: 1 and 1/2, a ball that settles
for from in "find y = 1, T = 0.9" "find T = 0.9"; do
    qdot -q - <<END 2>&1 | sed -n 's/ ±.*//; s/^floquet.*/&/p; /^run1/p' | sed 's/1\.0000[0-9]*/1/'
coord y
particle p mass 1 at y
gravity -10
event b: y = 0 falling then y' = -y'
start y = 1
$from such that returns after T
floquet
END
done
qdot -q - <<'END' 2>&1 | sed -n 's/ ±.*//; s/^\(floquet.[0-9]. = \)\(1\|1\.0000[0-9]*\|0\.9999[0-9]*\)\( [+-] [0-9.e-]*\*i\)*$/\11 nearly/p; /^run1/p'
coord x, y
particle p mass 1 at (x, y)
event b: x^2 + y^2 = 1 rising then x' = x' - 2*(x*x' + y*y')*x, y' = y' - 2*(x*x' + y*y')*y
start x = sqrt(1/2), y' = 1
find T = 5.6 such that returns after T
floquet
END
qdot -q - <<'END' 2>&1 | sed -n 's/ ±.*//; /^floquet/p; /^run1/p'
coord y
particle p mass 1 at y
gravity -10
event b: y = 0 falling then y' = -0.5*y' + 1
start y = 0.1, y' = sqrt(2)
find y' = sqrt(2), T = 0.4 such that returns after T
floquet
END
