# p[q], whose index is a coordinate and no number, where the name of a value stands.
for line in 'set p[x] = 2' 'run 0..1 with p[x] = 2' 'sweep p[x] = [1, 2] run 0..1 : m' \
    'find p[x] = 1 such that value(x, 1) = 2' 'run 0..1; sensitivity x of p[x]' \
    'run 0..1; fit p[x] to "none.csv" : t, x' 'run 0..2*pi; continue orbit in p[x] = 0..1' \
    'run 0..1 with p[y] = 2' 'sweep p[1] = [1, 2] run 0..1 : x' 'find p[1] = 1 such that value(x, 1) = 2'; do
    echo "> $line"
    qdot -q -e "param m = 1; coord x; lagrangian m*x'^2/2 - x^2/2; start x = 1; $line" 2>&1 | sed 's/, in .*//' |
        grep -v ' step\|error of the end\|cpu\|drift'
done
