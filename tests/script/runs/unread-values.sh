# Names whose values no run reads: momenta, and parameters on which nothing in the scene depends.
for line in 'run 0..1 with p[x] = 2' 'sweep p[x] = [1, 2] run 0..1 : x' 'find p[x] = 1 such that value(x, 1) = 2' \
    'run 0..1; sensitivity x of p[x]' 'run 0..1; fit p[x] to "none.csv" : t, x' \
    'run 0..1 with w = 3' 'run 0..1 with w = 3 as a; value(a.w, 1)' 'plan with w = 3' 'sweep w = [1, 2] run 0..1 : x' \
    'sweep w = [1, 2] run 0..1 : w*x' 'sweep m = [1, 2] run 0..1 with w = 3 : x' 'sweep w = [1, 2] run 0..w : x' \
    'find w = 1 such that value(x, 1) = 1' 'find w = 0..2 such that value(x, w) = 0' 'run 0..1 with m = w, w = 3' \
    'f = w*x; run 0..1 with w = 2' 'f(u) = w*u; run 0..1 with w = 2' 'start x = w; run 0..1 with w = 2' \
    'set m = w; run 0..1 with w = 2' 'event e: x = w; run 0..1 with w = 2' 'event e: x = 0 then w = 1; run 0..1 with w = 2'; do
    echo "> $line"
    qdot -q -e "param m = 1, w = 2; coord x; lagrangian m*x'^2/2 - x^2/2; start x = 1; $line" 2>&1 |
        sed 's/, in .*//' | grep '^-e\|hint:\|notice:\|^[0-9]\|^w ='
done
