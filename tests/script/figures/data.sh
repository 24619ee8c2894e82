# columns of a file beside curves: by name, by order, as points, over a variable, alone, in the terminal's sketch
scene='coord x, y; lagrangian (x'"'"'^2 + y'"'"'^2)/2 - (x^2 + y^2)/2; start x = 1, y'"'"' = 1; run 0..6'
printf '%s\n' 't,y,x' '0,0,1' '1,0.84,0.54' '8,0.99,-0.15' >named.csv
printf 'time\tangle\tnote\n0\t1\t7\n1\t0.5\t7\n' >other.tsv
printf '0 1\n1 2\n' >bare.dat
qdot -q -e "$scene" -e 'plot x, "named.csv" : t, x keep to "one.svg"' -e 'plot x, y, "named.csv" : t, x, y, "other.tsv" : t, x, skip lines keep to "two.svg"' \
    -e 'plot "named.csv" : x, y keep to "alone.svg" | plot "bare.dat" : s, v' -e 'plot cos(s), "named.csv" : t, x vs s = 0..6 keep to "over.svg"' \
    -e 'q = (x, y); plot q, "named.csv" : x, y to "path.tikz"' -e 'plot x, "named.csv" : t, x colour black, red points lines keep to "joined.png"' |
    grep wrote
for name in one two alone over joined; do
    echo "--- $name"
    sed -n '/label\|^plot\|^ *with\|, \$/p; /set xrange/p' $name.gp
    echo "$(grep -c '^[-0-9.]* [-0-9.]*$' $name.dat | sed 's/^[1-9][0-9][0-9]*$/many/') points"
done
sed -n '/addplot.*only marks/,/};/p; /legendentry/p' path.tikz
for text in 'x, "named.csv" : t, z' 'x, "named.csv" : t' '"none.csv" : t, x' '"bare.dat" : t, x, y' '"other.tsv" : t, x' 'x, "named.csv" : t, x vs y' \
    'x, "named.csv"' '"named.csv" : skip, x' '(x, y, t), "named.csv" : t, x' '"named.csv" : t, x for x = 1..2'; do
    qdot -q -e "$scene" -e "plot $text to \"n.svg\"" | grep -v '^ \|^run'
done 2>&1
ls n.svg 2>/dev/null
