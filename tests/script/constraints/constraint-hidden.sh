# Constraints of one direction that leave a condition together: it is named, whatever the method or the
# treatment of drift, and not dropped; said as a constraint it is held. What does repeat others runs.
try() { # LINES RUN
    printf 'coord x, y, z\nparticle p mass 1 at (x, y, z)\npotential y + z\n%s\n%s\n' "$1" "$2" |
        qdot -q --json - 2>/dev/null |
        sed -n 's/.*"kind":"run".*"status":"\([a-z]*\)".*/  \1/p
            s/.*"kind":"error".*"message":"\(.*\)","hint".*/  \1/p'
}
echo "on positions"
first="constraint a: x = t
constraint d: x' = y
start y = 1"
for run in "" "constraints none" "constraints baumgarte" "method msadams"; do
    try "$first" "run 0..1 $run"
done
try "$first
constraint e: y = 1" "run 0..1"
echo "on velocities"
try "constraint a: x' = y
constraint b: x' = z" "run 0..1"
try "constraint a: x = t^2/2
constraint d: x'' = 1 + y'" "run 0..1 method rk8pd"
echo "on time"
try "constraint a: x = t
constraint d: x' = cos(t)" "run 0..1 constraints none"
for run in "" "constraints none" "method msadams"; do
    try "constraint a: x = t^2
constraint b: x = t^2 + t^3" "run 0..1 $run"
done
echo "none"
try "constraint a: x = sin(t)
constraint d: x' = cos(t)
constraint c: x'' = -sin(t)" "run 0..1"
# Redundant constraints that the tape would solve for at loose tolerances.
try "constraint a: x = t
constraint d: x' = 1" "run 0..1 tol 1e-6"
echo "found on the way"
for run in "constraints none" "constraints baumgarte" "method msadams" "method rk8pd"; do
    try "constraint a: x = t
constraint d: x'' = max(0, t - 1/2)" "run 0..1 tol 1e-6 $run" | sort -u
done
echo "counted"
{
    printf 'coord x, y\nparticle p mass 1 at (x, y)\n'
    printf "constraint a: x = t\nconstraint d: x' = y\ndof\nconstraint e: y = 1\ndof\n"
} | qdot -q - 2>&1
