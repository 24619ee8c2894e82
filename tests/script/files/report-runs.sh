# Reports of several runs: compared on one page, work and precision measured once.

# The page $1 without what depends on the machine.
sections()
{
    sed -n '/<h2>The motions/,/<h2>The script/p' "$1" | sed -e '/<script/,/<\/script>/d' |
        sed -n -e '/^<h[23]>/p' -e 's/^<dt>\(run\|with\)</&/p' -e '/^<p>/p' \
            -e 's/<figcaption>.*/&/p' -e 's/.*<g class="dashed \(k.\)".*<text[^>]*>\([^<]*\)<.*/\1 \2/p' \
            -e '/^<tr>/s/\(<td>[^<]*<\/td><td>[^<]*<\/td><td>[^<]*<\/td><td>[^<]*\).*\(<td>[^<]*<\/td><\/tr>\)$/\1 \2/p' \
            -e '/<section/p' |
        sed -e 's/is [0-9.e-]*\.<\/p>/is _.<\/p>/' -e '/^<tr><td>[a-z0-9]*<\/td><td>[0-9]/d'
}

cat >cart.lag <<'END'
param m, k > 0
coord x
particle cart mass m at (x, 0)
potential s: 0.5*k*(x - 1)^2
set m = 1, k = 4
start x = 2
run 0..2 as a
run 0..2 method dop853 tol 1e-6 as b
run 0..3 with k = 1 as soft
workprecision 0..2 to "study.csv"
report a, b, soft workprecision to "three.html"
report a, b to "two.html"
set k = 9
report b workprecision to "one.html"
END
qdot -q cart.lag | grep wrote
sections three.html
echo '--- two'
sections two.html | grep -c 'Work and precision\|side'
echo '--- one: with the values of the run, not those of the moment'
sed -n '/<h2>Error/,/<h2>The script/{/^<h\|earlier/p}' one.html

# Changed in between: measured again.
sed -e '/^run.*soft/d' -e '/^report/d' -e 's/^workprecision.*/&\nremove s\npotential s: 0.5*k*(x - 1)^2\nreport b workprecision to "again.html"/' \
    cart.lag >again.lag
qdot -q again.lag | grep again
grep -c 'earlier' again.html

for names in 'a, a' 'a, none' 'a b' 'a,' 'a, b, c, d, e, f, g, h, i'; do
    qdot -q -e "coord x; lagrangian x'^2/2; run 0..1 as a; report $names to \"x.html\"" 2>&1 | sed -n '/error:/,$p'
done
