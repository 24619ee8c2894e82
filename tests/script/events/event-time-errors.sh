# What value() states covers the error of event times: a time in an expression, and the state
# behind a thousand impacts; a time at which companions by radau agree with the run by chance.
state=$(qdot -q --json - <<'LAG'
coord x, y
particle star mass 1 at (x, y)
potential (x^2 + y^2)/2 + x^2*y - y^3/3
event cr: x = 0 rising
start y = -0.15, x' = 0.54
run 0..60 tol 1e-6
value(cr[3], 60)
value(y - y + 2*cr[3], 60)
reset scene
coord x
particle p mass 1 at x
event r: x = 1 rising then x' = -x'
event l: x = 0 falling then x' = -x'
start x = 0.3, x' = sqrt(2)
run 0..1000 tol 1e-9
value(x, 1000)
reset scene
coord x
particle p mass 1 at x
potential x^2
force -3*x' on p
event e: x = 1e-3
start x = 1
run 0..100 method radau
e[1]
LAG
)
echo "$state" | sed -n 's/.*"kind":"number".*"value":\([-+.0-9e]*\),"error":\([-+.0-9e]*\).*/\1 \2/p' | awk '
BEGIN {
    truth[1] = 22.389846130829384; truth[2] = 44.779692261658768
    n = 0.3 + 1000*sqrt(2); k = int(n/2); n -= 2*k; truth[3] = n > 1 ? 2 - n : n
    truth[4] = 7.60065236573996482
}
{
    off = $1 - truth[NR]; if (off < 0) off = -off
    print (off <= 3*$2 && $2 <= 100*off + 1e-8) ? "covered" : "off by " off ", stated " $2
}'

# Two crossings that cannot be told from a touch: the error says how far from its time they may be.
qdot -q --json - <<'LAG' | sed -n 's/.*"values":\[\([-+.0-9e]*\)\],"errors":\[\([-+.0-9e]*\)\].*/\1 \2/p' | awk '{
    off = $1 - 6.2831852930374509; if (off < 0) off = -off
    print (off <= $2 && $2 < 1e-6) ? "covered" : "off by " off ", stated " $2
}'
coord x
particle p mass 1 at x
potential x^2/2
start x = 1
event e: x = 1 - 1e-16
run 0..10
e
LAG

# A relay with friction read in doubles: each of the crossings, which come ever faster, is known no better than the
# rounding of the place.
qdot -q --json - <<'LAG' | sed -n 's/.*"kind":"number".*"value":\([-+.0-9e]*\),"error":\([-+.0-9e]*\).*/\1 \2/p' | awk '
BEGIN { truth[1] = 1.000000306025987183; truth[2] = -0.000360304010132800248 }
{
    off = $1 - truth[NR]; if (off < 0) off = -off
    print (off <= $2 && $2 < 1e-6) ? "covered" : "off by " off ", stated " $2
}'
coord x
particle p mass 1 at x
force -0.5*sign(x - 1) - 2*x' on x
start x = 1, x' = 0.274
run 0..9.07 method radau
value(x, 9.07)
value(x', 9.07)
LAG
