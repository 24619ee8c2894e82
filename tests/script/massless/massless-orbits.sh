# Orbits of scenes with coordinates without mass, against SciPy: a damper's point (first order), a point between springs
# (a function of the rest), the latter two beside a rod; multipliers are those of the states that are left.
cut() {
    grep '^d(\|^[xyzP].* = \|^floquet\|able\|undecided\|error: ' |  sed 's/ ± .*//; s/\([0-9]\.[0-9]\{9\}\)[0-9]*/\1/g'
}
qdot -q - <<'END' 2>&1 | cut
coord x, y
particle p mass 1 at y
potential (y - x)^2
dissipation x'^2/4
force -x + 0.8*cos(1.3*t) on x
force -0.2*y' on y
start x = 0.1, y = 0.5
find x = 0.1, y = 0.5, y' = 0 such that returns after 2*pi/1.3
run 0..2*pi/1.3
floquet
END
qdot -q - <<'END' 2>&1 | cut
coord x, y
particle p mass 1 at y
potential (y - x)^2 + x^2/2 + y^4/4
start y = 1
param P
find P = 5 such that returns after P
run 0..P
floquet
END
qdot -q - <<'END' 2>&1 | cut
param l = 1, k = 2, c = 0.5
coord x, y, z
lagrangian (x'^2 + y'^2)/2 - y - k*(z - x)^2/2 - z^2/2
dissipation c*z'^2/2
constraint rod: x^2 + y^2 = l^2
force 0.2*sin(2*t) on z
start x = 0.1, y = -0.995, z = 0.1, x' = 0
find x = 0.1, x' = 0, z = 0 such that returns after pi
run 0..pi
floquet
END
# slopes beside a constraint
for more in '' 'dissipation z'"'"'^2/4'; do
qdot -q - <<END 2>&1 | cut
param l = 1, k = 2
coord x, y, z
lagrangian (x'^2 + y'^2)/2 - y - k*(z - x)^2/2 - z^2/2
$more
constraint rod: y = -sqrt(l^2 - x^2)
start x = 0.6${more:+, z = 0.1}
run 0..2
sensitivity value(x, 2) of x, k, l
sensitivity value(z, 2) of x, k, l
END
done
