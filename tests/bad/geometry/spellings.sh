# Words of the language that are not built yet, and near spellings, each with a line that goes on.
scene="param l; coord x; lagrangian x'^2/2 - l*x^2/2; set l = 1; start x = 1"
for line in 'solve x^2 = 4' 'check x =< 1' 'conserved(energy)' 'find x = 0..1 so that returns after 1' 'H(x, p[x])' \
    'data drive from "drive.csv" : t, F' 'joint hinge J between A, B at P axis u' 'steady' 'steady[1]' 'canonical(x, p[x])' \
    'units E' 'hamilton_jacobi' 'action(x)'; do
    qdot -q -e "$scene; $line" 2>&1 | sed '2,3d'
done
qdot -q -e "$scene; run 0..1" -e 'plot x to "f.svg" for l = [1, 2]' 2>&1 | tail -n 1
qdot -q -e "$scene; run 0..1 with l = 3" -e 'value(x, 1) for l = [1, 2]' 2>&1 | tail -n 1
