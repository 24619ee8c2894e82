# A run for each value: numbers of it as rows, with their errors.
same='s/in [0-9.e-]* s/in S/; s/  */ /g; s/^ //' # what is compared
cat >scene.lag <<'END'
param m > 0, k = 4, c = 0.2, F = 1, omega
coord x
particle p mass m at x
potential k*x^2/2
force F*cos(omega*t) - c*x' on x
set m = 1
END
qdot -q scene.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | sed '/^now:/,/x = /d'
# the steady amplitude of a driven oscillator is F/sqrt((k - m*omega^2)^2 + c^2*omega^2)
sweep omega = 1..3 step 1 run 0..200 : max(abs(x), 190..200) as curve
table curve
# several names, the last the fastest; lists, counts, initial values; any numbers of a run
event cross: x = 0 falling
sweep omega = [1, 2], x = -1..1 count 3 run 0..1 tol 1e-9 : value(x, 1/2), m*value(x', 1), x as grid
# the same as a run of that member
start x = 1
set omega = 2
run 0..1 as now
check value(x, 1) == -0.1218486 within 1e-6
END
qdot -q scene.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same"
event cross: x = 0 falling
set omega = 2
start x = 1
# what is asked for, a run, a value may fail in some rows
sweep x = [-1, 1], omega = [0, 1/2] run 0..1 : cross[1], 2*cross[1] as first
table first
sweep m = 0..1 step 1/2 run 0..1 : x as masses
event late: t = 1/2 stop
sweep x = [1, 2] run 0..1 : t, x'
# random numbers, by a seed; an older table of that name goes, and comes back
sweep omega = normal(2, 0.1), x = uniform(-1, 1) count 3 seed 7 run 0..1/4 : x as cloud
sweep x = uniform(-1, 1) count 2 run 0..1/4 : x, x' as cloud
undo
table cloud
# the values are again what they were
run 0..1/4
value(x, 0)
END
qdot -q scene.lag -e 'run 0..1 with omega = 2, x = 1; value(x, 1/2); value(m*x'"'"', 1)' | awk -f six.awk | sed "$same" | tail -n 2
# as JSON: values and errors of what was swept and of what was asked for
qdot --json scene.lag -e 'sweep omega = [1], x = [0, 1] run 0..1 : value(1/x, 0) as r' | awk -f six.awk | sed "$same; s/[0-9.]*e-[0-9]*/TINY/g"
# files
qdot -q scene.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same"
event cross: x = 0 rising
sweep omega = 1..2 step 1/2 run 0..4 : x, cross[1] as r
save r to "r.csv"
table r to "r.json"
save r to "r.h5"
plot r to "r.svg"
sweep omega = 1..2 count 2, x = 0..1 count 2 run 0..1 : x as s
plot s
sweep omega = [1, 2] run 0..1 : cross[7]
END
awk -f six.awk r.csv | sed "$same"
tail -n 1 r.json | awk -f six.awk | sed "$same"
grep -c '<svg' r.svg
# Beyond the horizon no digit is known: none is printed.
qdot -q - <<'END' 2>&1 | awk -f six.awk | sed "$same"
coord a, b
particle p mass 1 at (sin(a), -cos(a))
particle q mass 1 at (sin(a) + sin(b), -cos(a) - cos(b))
gravity (0, -9.81)
start b = 2
sweep a = 2..3 step 1 run 0..100 : a, energy as chaos
END
echo '# numbers over two names are a map, of uneven values with cells of their widths; over three a map for each value of the first'
qdot -q scene.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v rows
set omega = 2
sweep k = 1..2 count 2, x = -1..1 count 3 run 0..1 tol 1e-9 : k*value(x, 0), x as map
plot map keep to "map.svg"
sweep k = [1, 2, 4], x = -1..1 count 3 run 0..1 tol 1e-9 : x as uneven
plot uneven keep to "uneven.svg"
sweep k = [1, 4, 2], x = [0, 1] run 0..1 tol 1e-9 : k as mixed
plot mixed keep to "mixed.svg"
sweep k = [1, 2], x = [0, 1], c = [0, 1] run 0..1 tol 1e-9 : x as cube
plot cube keep to "cube.svg"
sweep k = 1..2 count 20, x = [0, 1], c = [0, 1] run 0..1 tol 1e-9 : x as long
plot long
END
sed -n '1,/^$/p' map.dat
awk 'NF == 3 && $2 == 0 {if ($3 != last) print $1, $3; last = $3}' uneven.dat | awk '{printf "%.4f %.6f\n", $1, $2}' # cells from 1, 1.5, 3
awk 'NF == 3 && $2 == 0 && $3 != last {print $3; last = $3}' mixed.dat # in their order along the axis
grep -o "^set title '[^']*'" cube.gp
