# xlabel, ylabel: the text of one axis, the other keeps its own; beside `labels` they are refused
scene='coord x, y; lagrangian (x'"'"'^2 + y'"'"'^2)/2 - (x^2 + y^2)/2; start x = 1, y'"'"' = 1; run 0..6'
texts() { grep -ho "set [xy]label '[^']*'" "$1"; }
qdot -q -e "$scene" -e 'plot x, y xlabel "t in s & _more_" keep to "x.svg"' -e 'plot x vs y ylabel "across" keep to "y.svg"' \
    -e 'plot x xlabel "time" | plot y ylabel "up" xlabel "time" keep to "both.png"' \
    -e 'plot sin(s) vs s = 0..6 ylabel "sine" to "sine.tikz"' \
    -e 'sweep x = 1..3 count 3 run 0..1 : value(x, 1)' -e 'plot sweep1 xlabel "x_0" keep to "rows.eps"' |
    grep wrote
for name in x y both rows; do
    echo "--- $name"
    texts $name.gp
done
grep '[xy]label=' sine.tikz
for text in 'labels "a", "b" xlabel "c"' 'ylabel "c" labels "a"' 'xlabel "a" xlabel "b"' 'xlabel up' 'ylabel'; do
    qdot -q -e "plot s^2 vs s = 0..1 $text"
    echo "exit $?"
done
ls *-1.svg 2>/dev/null
