# One scene in every formulation: who runs, that all end at the same state, that drift goes
# where nothing is done against it.
qdot -q --json - <<'END' >race.json
param m1 = 1, m2 = 1, L1 = 1, L2 = 1, g = 9.81
coord x1, y1, x2, y2
particle a mass m1 at (x1, y1)
particle b mass m2 at (x2, y2)
constraint rod1: x1^2 + y1^2 = L1^2
constraint rod2: (x2 - x1)^2 + (y2 - y1)^2 = L2^2
gravity (0, -g)
start x1 = sin(2), y1 = -cos(2), x2 = 2*sin(2), y2 = -2*cos(2)
race 0..2 to "race.svg"
END
sed -n 's/^{"kind":"row","values":\[\(.*\)\],"statement.*/\1/p' race.json | sed 's/"as given, /"as given: /' | awk -F, '
    { if (!rows[$1]++) name[++n] = $1; if ($3 < 2e-12 && $4 < 1e-11) good[$1]++ }
    $1 ~ /projected/ && $6 > 1e-14 { print "projected, yet adrift: " $0 }
    $1 ~ /none/ && $3 > 1e-5 && $6 > 1e-9 { adrift = 1 }
    END { for (i = 1; i <= n; i++) print name[i], rows[name[i]], good[name[i]]; print "adrift", adrift }'
grep -c '<path' race.svg | sed 's/^0$/empty/; s/^[1-9].*/curves/'
# a spring, a damper and a drive move to the new coordinates; a knife edge has none
qdot -q - <<'END' | sed -n 's/^\([0-9]* coordinates\)/\1/p; s/^not in/not in/p'
param w = 2
coord x, y, X, th
particle bob mass 1 at (x, y)
body wheel mass 1 inertia 1/2 at (X, 1) angle th
constraint rod: (x - X)^2 + y^2 = 1
constraint drive: X = sin(w*t)
constraint roll: th = X
spring s between bob, (0, 0) stiffness 5 rest 1
damper d between bob, (0, 3) coefficient 1
force (1, 0) on bob
start x = 1, y = 0, X = 0
race 0..1
reset
coord x, y, phi
body s mass 1 inertia 1 at (x, y) angle phi
constraint blade: x'*sin(phi) = y'*cos(phi)
start x' = 1, phi' = 1
race 0..1
remove blade
torque 1 on x
constraint wall: x = 1
race 0..1
END
# constraints in velocities that are holonomic in disguise
qdot -q - <<'END' | sed -n 's/^\([0-9]* coordinates\)/\1/p; s/^not in/not in/p'
coord x, phi
body w mass 1 inertia 1/2 at (x, 1) angle phi
potential x^2
constraint roll: x' + phi' = 0
start x = 1
race 0..10
reset
coord x, y
particle b mass 1 at (x, y)
gravity (0, -10)
constraint rod: x*x' + y*y' = 0
start x = 1, y = 1/2
race 0..2
END
# spheres: a spherical pendulum whose start is a pole of the usual angles, and two in a row
for scene in one two; do
    {
        cat <<'END'
param l = 1, g = 9.81
coord x, y, z
particle a mass 2 at (x, y, z)
gravity (0, 0, -g)
constraint rod: x^2 + y^2 + z^2 = l^2
END
        [ $scene = one ] || cat <<'END'
coord X, Y, Z
particle b mass 1 at (X, Y, Z)
constraint next: (X - x)^2 + (Y - y)^2 + (Z - z)^2 = l^2
start X = 0.6, Y = 0, Z = -1.8
END
        echo "start x = 0, y = 0, z = -1, x' = 1, y' = 2, z' = 0"
        echo "race 0..2"
    } >sphere.lag
    qdot -q --json sphere.lag >sphere.json
    grep -o '[0-9] coordinates as given, [0-9] in minimal' sphere.json
    sed -n 's/^{"kind":"row","values":\[\(.*\)\],"statement.*/\1/p' sphere.json |
        awk -F, '$1 ~ /minimal/ && $3 < 2e-12 && $4 < 1e-11 { good++ } END { print "minimal", good }'
done
# an event that changes the motion is in the coordinates as given
qdot -q - <<'END' | sed -n 's/^not in/not in/p'
param m = 1, g = 2
coord x, y
particle bob mass m at (x, y)
gravity (0, -g)
constraint rod: x^2 + y^2 = 1
event low: x = 0 then g = 3
start x = 3/5, y = -4/5
race 0..2 to "events.svg"
END
