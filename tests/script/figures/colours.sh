# colours by name, one for each curve; points that are joined by lines; lines in place of points
scene='coord x, y; lagrangian (x'"'"'^2 + y'"'"'^2)/2 - (x^2 + y^2)/2; start x = 1, y'"'"' = 1; run 0..6'
looks() { grep -o "with [a-z]*\|rgb '[^']*'\|dashtype [^ ]*" "$1" | sed -n "/linecolor\|e0e0e0/d;p"; }
qdot -q -e "$scene" -e 'plot x, y, x*y colour red keep to "c.svg"' -e 'plot x, y colour black, cyan points lines keep to "p.svg"' \
    -e 'plot x lines colour green | plot y, x*y colour pink, blue points keep to "two.eps"' \
    -e 'plot x, y colour orange, black lines points to "c.tikz"' \
    -e 'sweep x = [1, 3, 2] run 0..1 : value(x, 1); plot sweep1 lines keep to "rows.svg"; plot sweep1 keep to "own.svg"' | grep wrote
for name in c p two rows own; do
    echo "--- $name"
    looks $name.gp
done
grep -o 'color=.*\]' c.tikz
for text in 'colour purple' 'colour red, green' 'colour "red"' 'colour' 'color red' 'lines lines' 'colour 3'; do
    qdot -q -e "plot s^2 vs s = 0..1 $text to \"n.svg\""
    echo "exit $?"
done
ls n.svg 2>/dev/null
