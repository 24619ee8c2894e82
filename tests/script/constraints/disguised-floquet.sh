# A velocity constraint that is holonomic in disguise leaves its leaf's directions alone: multipliers and verdict are those
# of the scene with its integral; a true one leaves all others.
cut() {
    grep '^floquet\|stable\|undecided\|error: ' | sed 's/ ± .*//; s/\([0-9]\.[0-9]\{9\}\)[0-9]*/\1/g'
}
for constraint in "x*x' + y*y' + z*z' = 0" 'x^2 + y^2 + z^2 = 1'; do
qdot -q - <<END 2>&1 | cut
coord x, y, z
particle p mass 1 at (x, y, z)
potential z + x^2/2
constraint s: $constraint
start x = 0, y = 0.3, z = -sqrt(1 - 0.3^2), y' = 0, x' = 0
param P
find P = 6 such that returns after P
run 0..P
floquet
END
done
qdot -q - <<'END' 2>&1 | cut
param r = 1/2, c = 0.1
coord x, phi, th
lagrangian th'^2/2 + 1.3*x'^2/2 + 0.3*phi'^2/2 - x^2 - x^4/4 + cos(th - x)
constraint roll: x' + r*phi' = 0
force -c*th' + 0.3*cos(2*t) on th
start x = 0.1
find x = 0.1, x' = 0, th = 0, th' = 0 such that returns after pi
run 0..pi
floquet
END
qdot -q - <<'END' 2>&1 | cut
coord x, y, z
lagrangian (x'^2 + y'^2 + z'^2)/2 - x^2/2 - y^2 - z^2
constraint k: z' - y*x' = 0
start y' = 1
run 0..2*pi/sqrt(2)
floquet
END
