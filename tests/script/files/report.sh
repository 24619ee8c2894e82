# Reports: what stands on the page. Needs no browser.

# The page $1 without style, programs, data, formulas and curves.
outline()
{
    sed -e '/<style>/,/<\/style>/d' -e '/<script/,/<\/script>/d' "$1" |
        sed -e 's/<math>/{/g; s/<\/math>/}/g; s/{[^}]*}/{}/g; s/d="[^"]*"/d/g' \
            -e 's/<path[^>]*>//g; s/<text [^>]*>[^<]*<\/text>//g' \
            -e 's/tol [0-9e-]*, [0-9]* steps*/tol, steps/; s/at most [0-9e-]*/at most/g' \
            -e 's/energy [0-9e-]*</energy</; s/qdot [0-9.]*</qdot</' |
        sed -e '/^<pre>.*: t = /,/<\/pre>/d' -e '/<h2>Equations/,/<h2>Conserved/{/<h3>\|<p/d}'
}

cat >pendulum.lag <<'END'
param m, L, g > 0
coord theta
particle bob mass m at (L*sin(theta), -L*cos(theta)) # at first < at last
gravity (0, -g)
style unicode
set m = 1, L = 1, g = 9.81
start theta = 1
run 0..5
theta
report to "pendulum.html"
%
style plain
report run1 title "A <pendulum> & more" to "titled.html"
END
qdot -q pendulum.lag | sed -n '/^θ\|^wrote/p'
outline pendulum.html
sed -n '/<h1>/p' titled.html
sed -n '/Equations of motion/,/Conserved/p' pendulum.html | grep -c 'class="formula"><math>'
grep -c '<section class="animation">' pendulum.html
grep -c 'https*:' pendulum.html

# Tags that open and close as they should, formulas too.
awk '{
    line = $0
    while (match(line, /<\/?(math|mrow|mfrac|msup|msub|mover|mtable|mtr|mtd|mi|mo|mn|mtext|p|h1|h2|h3|pre|dl|dt|dd|svg|figure|figcaption|text|section|main|body|html|head|style|script|title)[ >]/)) {
        tag = substr(line, RSTART, RLENGTH - 1)
        line = substr(line, RSTART + RLENGTH - 1)
        if (inside && tag != "</" inside) continue
        if (tag ~ /^<\//) {
            if (stack[n] != substr(tag, 3)) { print "not closed: " stack[n] " before " tag; exit }
            n--
            inside = ""
        } else {
            stack[++n] = substr(tag, 2)
            inside = stack[n] ~ /^(script|style)$/ ? stack[n] : ""
        }
    }
} END { print n + 0 " left open" }' pendulum.html

# Work and precision: a figure and a table of methods.
qdot -q -e 'coord x; lagrangian x'"'"'^2/2 - x^2/2; start x = 1; run 0..2; report workprecision to "work.html"' | grep wrote
sed -n '/<h2>Error/,/<h2>The script/p' work.html | sed -n 's/^<tr><td>\([a-z0-9]*\)<.*/\1/p' | sort -u | grep -c 'dop853\|taylor'
sed -n '/<h2>Error/,/<h2>The script/p' work.html | grep 'class="mark.*<text' | grep -c 'dop853\|taylor'
qdot -q -e 'coord x; report workprecision to "x.html"' 2>&1 | grep error

# A stated Lagrangian, and no run.
qdot -q - <<'END'
coord x
lagrangian x'^2/2 - x^2/2
report title "Oscillator" to "stated.html"
START = 1
start x = 1
run 0..3
report to "stated-run.html"
END
outline stated.html
echo '--- with a run'
outline stated-run.html | sed -n '/<h2>The motion/,$p'

# Paper: A4, and where the country of the locale uses it US letter.
for locale in C de_DE.UTF-8 en_US.UTF-8 es_MX; do
    LC_ALL=$locale qdot -q -e 'coord x; particle p mass 1 at x' -e 'report to "paper.html"' >/dev/null 2>&1
    echo "$locale $(grep '^@page{size' paper.html)"
done
LC_ALL= LC_PAPER=de_DE.UTF-8 LANG=en_US.UTF-8 qdot -q -e 'coord x; particle p mass 1 at x' -e 'report to "paper.html"' >/dev/null 2>&1
grep '^@page{size' paper.html
