# Where no error can be stated it is said to be unknown, and why; what is rounding only ends.
known()
{
    sed -n 's/.*"kind":"n[ou][a-z]*",//p' | sed 's/,"statement.*}/}/; s/[0-9]* steps/N steps/; s/one took [0-9]*/one took N/; s/at t = .*/at t = .../
s/"name":"\(.*\)","value":[^,]*,"error":\(.*\)}/\1: \2/; s/: [0-9].*/: known/'
}
# At rest: one step crosses 1e9 s, while a second run, moved by a rounding, would swing.
printf 'coord theta
particle b mass 1 at (sin(theta - 1), -cos(theta - 1))
gravity (0, -9.81)
start theta = 1
run 0..1e9
value(theta, 10)
value(theta, 1e8)
max(theta, 0..1e8)
' | qdot -q --json - 2>/dev/null | known
# Through the pole of spherical coordinates: what is moved beside it turns by pi there.
printf 'coord theta, phi
particle b mass 1 at (sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta))
gravity (0, 0, -9.81)
start theta = 1
run 0..5
value(phi, 1/2)
value(phi, 4)
' | qdot -q --json - 2>/dev/null | known
# What is nothing but rounding has extrema of that size.
printf 'coord x, y
particle bob mass 1 at (x, y)
constraint rod: x^2 + y^2 = 1
gravity (0, -9.81)
start x = 1
run 0..3
check max(abs(norm(bob) - 1), 0..3) < 2e-15
check min(norm(bob), 0..3) == 1 within 2e-15
check mean(norm(bob), 0..3) == 1 within 1e-14
' | qdot -q - 2>&1 | sed -n '/^[pr][re]/p'
