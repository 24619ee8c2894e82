# names of curves, one scale for both axes, points that are not joined, PostScript
scene='coord x, y; lagrangian (x'"'"'^2 + y'"'"'^2)/2 - (x^2 + y^2)/2; start x = 1, y'"'"' = 1; run 0..6'
qdot -q -e "$scene" -e 'plot x, y legend "across & _up_", "up" keep to "l.svg"' -e 'plot x vs y equal points keep to "e.svg"' \
    -e 'plot x, y legend "first only" to "f.eps"' -e 'plot sin(s), cos(s) vs s = 0..6 points | plot x to "two.svg" keep' |
    grep wrote
grep -ho "title .*" l.gp
grep -c 'ratio -1' e.gp
grep -o 'with points' e.gp
grep -o 'with [a-z]*' two.gp
head -n 1 f.eps
qdot -q -e "$scene" -e 'plot x, y legend "a", "b", "c" to "n.svg"'
