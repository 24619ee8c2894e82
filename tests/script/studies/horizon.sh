# A chaotic run says from where on it means nothing; a regular one has no such time.
double='coord theta1, theta2
r1 = (sin(theta1), -cos(theta1))
particle a mass 1 at r1
particle b mass 1 at r1 + (sin(theta2), -cos(theta2))
gravity (0, -9.81)
start theta1 = 2, theta2 = 2
'
# the number behind "$1": between $2 and $3 ?
between()
{
    sed -n "s/.*\"$1\":\\([^,}]*\\).*/\\1/p" |
        awk -v name="$1" -v low="$2" -v high="$3" '{
            good = $1 >= low && $1 <= high
            print name, ($1 == "null" ? $1 : good ? "good" : "bad: " $1) }'
}
printf '%srun 0..100\n' "$double" | qdot -q --json - | between horizon 23.5 27
printf '%srun 0..100\n' "$double" | qdot -q --json - | between error 1 1e4
# sines are apart by 2 at most, and stated is 5/4 of the distance of a companion and that between both
printf '%srun 0..100\nvalue(sin(theta1), 97)\n' "$double" | qdot -q --json - |
    grep '"kind":"number"' | between error 0.4 4.5
printf '%srun 0..20\n' "$double" | qdot -q --json - | between horizon 0 0
printf '%srun 0..100\n' "$double" | qdot -q - | sed -n 's/t = [0-9.]*, where/t = T, where/; /horizon/p; /theta/p'
printf '%srun 0..100 tol 1e-5\n' "$double" | qdot -q - | sed -n 's/t = [0-9.]*;/t = T;/; /horizon/p; /theta/p'
# back in time it lies on the other side
printf '%srun 0..-100\n' "$double" | qdot -q --json - | between horizon -27 -23.5
# an end that is worth nothing is still one to go on from, and `digits` has it
printf '%srun 0..27 digits 6\n' "$double" | qdot -q --json - >far
between error 0 1e-6 <far
between horizon 0 0 <far
# what an event changes is conserved between events only, and not told as what holds
qdot -q - <<END | grep '^  beyond it'
coord a, b
lagrangian a'^2 + b'^2/2 + a'*b'*cos(a - b) + 2*cos(a) + cos(b)
event kick: a = 0 rising then a' = 0.9999*a'
start a = 2, b = 2.5
run 0..150
END
