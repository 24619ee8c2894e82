# Members of a sweep side by side: what runs alone give, the same bits in any company, and why not.
# Rows of two CSV files with the same first number, which agree within their errors.
agree() {
    awk -F, 'FNR == 1 { next }
             { n = (NF - 1) / 2 }
             FNR == NR { for (i = 2; i <= NF; i++) a[$1, i] = $i; seen[$1] = 1; next }
             $1 in seen { rows++
                 for (i = 2; i <= n + 1; i++) {
                     if ($i !~ /^[-+.e0-9]+$/) { off += $i != a[$1, i]; continue }
                     by = $i - a[$1, i]; if (by < 0) by = -by
                     compared++
                     if (!(by <= $(i + n) + a[$1, i + n])) off++ } }
             END { print rows " rows, " compared " numbers, " off + 0 " beyond their errors" }' "$1" "$2"
}
cat >double.lag <<'END'
param l = 1
coord a, b
particle p mass 1 at (l*sin(a), -l*cos(a))
particle q mass 1 at (l*sin(a) + sin(b), -l*cos(a) - cos(b))
gravity (0, -9.81)
event under: b = 0 falling
start a = 1, b = 1
END
# so few that each is a run alone, and the same among others
few='[1/4, 1/2, 3/4, 5/4]'
many='[1/8, 1/4, 3/8, 1/2, 5/8, 3/4, 7/8, 1, 9/8, 5/4, 11/8, 3/2, 13/8, 7/4, 15/8, 2, 17/8, 9/4]'
turned='[9/4, 17/8, 2, 15/8, 7/4, 13/8, 3/2, 11/8, 5/4, 9/8, 1, 7/8, 3/4, 5/8, 1/2, 1/4]'
for what in 'a 1e-9 a, b'"'"', energy, under[1]' 'l 1e-6 a, l*b'"'"', t, under[2]' 'l 1e-12 under[3]'; do
    set -- $what
    name=$1 tol=$2
    shift 2
    qdot -q double.lag - <<END 2>&1 | sed -n 's/ rows\(.*\), in .*/ rows\1/p; /rror/p'
sweep $name = $few run 0..5 tol $tol : $* as few threads 1
sweep $name = $many run 0..5 tol $tol : $* as many threads 1
sweep $name = $turned run 0..5 tol $tol : $* as turned threads 3
save few to "few.csv"
save many to "many.csv"
save turned to "turned.csv"
END
    agree few.csv many.csv
    sort many.csv >a
    sort turned.csv | comm -23 - a | wc -l | tr -d ' '
done
echo '# forces that act for less than a step, quotients, momenta, bounds; back in time'
cat >bump.lag <<'END'
param w = 1
coord x
particle p mass 1 at x
potential exp(-1000*(x - 5)^2)/20 + 1/(1000*((x - 3)^2 + w))
END
cat >kepler.lag <<'END'
coord r > 0, phi
particle p mass 1 at (r*cos(phi), r*sin(phi))
potential -1/r
event turn: phi = 3
start r = 1
END
few='[1/4, 1/2, 1, 3/2, 5/2]'
many='[1/4, 1/2, 3/4, 1, 5/4, 3/2, 7/4, 2, 9/4, 5/2, 11/4, 3, 13/4, 7/2, 15/4, 4, 17/4]'
for what in "bump x' 0..20 x, x'" "bump w 0..20 x, x'" "kepler phi' 0..9 r, phi, phi', turn[1]" \
    "kepler phi' 0..-9 r, phi"; do
    set -- $what
    scene=$1 name=$2 time=$3
    shift 3
    qdot -q $scene.lag - <<END 2>&1 | sed -n 's/ rows\(.*\), in .*/ rows\1/p; /rror/p'
$([ $name != w ] || echo "start x' = 2")
sweep $name = $few run $time : $* as few
sweep $name = $many run $time : $* as many
save few to "few.csv"
save many to "many.csv"
END
    agree few.csv many.csv
done
echo '# constraints; walls; a cusp, which is left to runs alone'
cat >rods.lag <<'END'
param A
coord x, y, u, w
particle p mass 1 at (x, y)
particle q mass 1 at (u, w)
gravity (0, -9.81)
constraint upper: x^2 + y^2 = 1
constraint lower: (u - x)^2 + (w - y)^2 = 1
event low: x = 0 falling
start x = sin(A), y = -cos(A), u = sin(A) + sin(1), w = -cos(A) - cos(1)
END
cat >wall.lag <<'END'
param w = 30
coord x
particle p mass 1 at x
potential x^2/2 + exp(w*(x - 2)) + exp(-w*(x + 2))
event low: x = 0 rising
END
cat >cusp.lag <<'END'
param A
coord x, y
particle p mass 1 at (x, y)
gravity (-1, 0)
constraint c: y^2 = x^3
start x = A^2, y = A^3
END
# compare TOL SCENE NAME TIME COLUMN...: few members, which are run alone, and many, by lanes; by one process and three
compare() {
    tol=$1 scene=$2 name=$3 time=$4
    shift 4
    qdot -q $scene.lag - <<END 2>&1 | sed -n 's/ rows\(.*\), in .*/ rows\1/p; /rror:/p; /^each/p'
$([ $name != w ] || echo "start x' = 2")
plan sweep $name = $many run $time $tol : $*
sweep $name = $few run $time $tol : $* as few threads 1
sweep $name = $many run $time $tol : $* as many threads 1
sweep $name = $many run $time $tol : $* as others threads 3
save few to "few.csv"
save many to "many.csv"
save others to "others.csv"
END
    agree few.csv many.csv
    cmp many.csv others.csv
}
for what in 'rods A 0..3 x, w, energy, low[1]' 'wall x'"'"' 0..20 x, x'"'"', low[1]' 'cusp A 0..5 x, y'; do
    compare '' $what
done
echo '# extrema, means and drifts along the way'
for what in "double a 0..5 max(a), min(b, 1..4), mean(energy), value(a, 5/2), max(b'')" \
    "double l 0..5 max(l*a), min(abs(b), 1..4), mean(a^2), drift(energy), value(a*l + t, 5/2), a', under[1]" \
    "bump w 0..20 max(x, 1..3), mean(x*w), value(x, 7)" \
    "kepler phi' 0..9 max(r), min(r), mean(phi'), drift(energy), value(phi', 4), turn[1]" \
    "kepler phi' 0..-9 max(r), mean(phi'), value(phi', -4)" \
    "rods A 0..3 max(x), mean(w), value(x*A, 2), max(x''), max(lambda[upper])" \
    "wall x' 0..20 max(abs(x)), max(x, 10..20), mean(x'^2), max(x) - min(x)"; do
    compare 'tol 1e-9' $what
done
echo '# plans'
cut='s/^time: [^ ]* s a member, by \([0-9]*\) of them: about .*/time: by \1/; s/^processes: .*/processes: N/; s/, about as much again.*//; s/^memory: [78]\.[0-9] MB/memory: 8 MB nearly/; s/^memory: 0\.00[01][0-9]* MB/memory: 0.001 MB nearly/'
qdot -q double.lag - <<'END' 2>&1 | sed -e '/disable-threads/d' -e "$cut"
plan sweep a = 0..1 count 1000, b = -pi..pi count 100 run 0..1 : a, under[2] threads 2
plan sweep a = 0..1 count 8 run 0..1 : a
plan sweep a = 0..1 count 20 run 0..1 : max(a)
plan sweep a = 0..1 count 20 run 0..1 : max(a, 0..under[1])
plan sweep a = 0..1 count 20 run 0..1 method dop853 : a
plan sweep a = 0..1 count 20 run 0..1 tol 1e-15 : a
plan sweep b = uniform(0, 1) count 20 seed 3 run 0..1 digits 20 : a
param k
set k = l^2
plan sweep l = 1..2 count 20 run 0..1 : a
event high: b = 3 stop
plan sweep a = 0..1 count 20 run 0..1 : a
END
for wrong in 'plan sweep a = 0..1 count 20 run 0..1' 'plan sweep c = 0..1 count 20 run 0..1 : a' \
    'plan sweep a = 0..1 count 20 run 0..1 : a + nobody'; do
    qdot -q double.lag -e "$wrong" 2>&1
done
