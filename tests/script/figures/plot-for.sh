# A loop over a parameter or a coordinate: the latest run once more for each value, a curve each.
scene='param k = 1; coord x; particle p mass 1 at x; potential k*x^2/2; start x = 1'
qdot -q -e "$scene; run 0..2*pi/k as a" \
    -e 'plot x for k = [1, 4] to "k.svg" keep' -e 'plot x for x = [1, 3] to "x.svg" keep' \
    -e "plot x' vs x for k = [1, 4], x = [1, 2] keep to \"kx.svg\"" -e 'plot x | plot x for k = 1..2 to "two.svg"' \
    -e 'run 0..3 with k = 9 tol 1e-9; plot k*x for k = [1, 4] to "w.svg" keep' -e 'show a' | grep -v '^ '
# x = cos(t) to 2 pi, cos(2 t) to pi/2; x = 3 cos(t); k*x = 4 cos(2 t)
awk '
    function off(a, b) { return a > b ? a - b : b - a }
    FNR == 1 { index_ = 0 }
    /^# [^l]/ { print FILENAME, $0; index_++; most[FILENAME, index_] = 0; next }
    /^[-0-9]/ {
        w = index_
        if (FILENAME == "k.dat") d = off($2, cos((w == 2 ? 2 : 1)*$1))
        else if (FILENAME == "x.dat") d = off($2, (w == 2 ? 3 : 1)*cos($1))
        else if (FILENAME == "w.dat") d = off($2, w == 2 ? 4*cos(2*$1) : cos($1))
        else { k = w > 2 ? 4 : 1; a = w % 2 ? 1 : 2; d = off($2^2/k + $1^2, a^2) }
        if (d > most[FILENAME, w]) most[FILENAME, w] = d
        n[FILENAME, w]++
        last[FILENAME, w] = $1
    }
    END {
        for (i in n) { bad += !(n[i] > 50 && most[i] < 1e-9); curves++ }
        print curves, "curves,", bad + 0, "off"
        printf "%.10f %.10f\n", last["k.dat", 1], last["k.dat", 2]
    }' k.dat x.dat kx.dat w.dat
# what cannot be made once more, and what reads one run
for line in 'set k = 2; plot x for k = [1, 4]' 'plot a.x for k = [1, 4]' 'value(x, 1) for k = [1, 2]' \
    '{ value(x, 1); max(x, 0..1) } for k = [1, 2]' 'max(x, 0..1) for x = [1, 2]' 'drift(energy) for k = [1, 2]' 'plot x for x' \
    'plot x for k = [1, -1e6] to "e.svg"' 'param z; plot x for z = 1..2'; do
    qdot -q -e 'param k = 1; coord x; particle p mass 1 at x; potential k*x^2/2; start x = 1; run 0..1 as a' \
        -e "$line" 2>&1 | sed 1,7d
done
# the hint as typed
qdot -q -e "$scene; run 0..1" -e '{ run 0..1; value(x, 1); max(x, 0..1) } for k = [1, 2]' | grep -v '^ '
# along a run of the pass a coordinate that is held moves
qdot -q -e "$scene" -e '{ run 0..3; table x, x'"'"' every 3; poincare x = 0 : x, x'"'"' } for x = [1, 3]' | grep -v '^  '
# what is typed as the hint says works: its run is as long as the value needs
hint=$(qdot -q -e "coord x; param k = 1; particle p mass 1 at x; potential k*x^2/2; start x = 1; run 0..1 tol 1e-9 as a
value(x, 5) for k = [1, 4]" 2>&1 | sed -n 's/^ *hint: //p')
echo "$hint"
qdot -q -e "coord x; param k = 1; particle p mass 1 at x; potential k*x^2/2; start x = 1; $hint" | grep '^value'
