# Figures for LaTeX: axes of pgfplots with labels from formulas. Where LaTeX with pgfplots is installed they are compiled
# (which says nothing if it succeeds); without it only what is written is compared.
scene="param V_0 = 2; coord theta, x_max; particle a mass 1 at (sin(theta), -cos(theta)); particle b mass 1 at (x_max, 0)
gravity (0, -9.81); potential x_max^2; start theta = 2, x_max = 1; run 0..4"
qdot -q -e "$scene" -e "plot theta' vs theta ticks pi to \"phase.tikz\"" 2>&1 | grep -v '^ \|^run'
qdot -q -e "$scene" -e "plot theta'^2/(2*V_0), sqrt(x_max^2 + 1), x_max' legend \"50% & \$_1\$\" title \"{a}\" to \"key.tikz\"" \
    -e "plot theta | plot theta' to \"panels.tikz\"" -e 'plot a to "path.tikz"' -e 'plot theta keep to "kept.tikz"' 2>&1 |
    grep -v '^ \|^run'
qdot -q -e 'plot 1/x vs x = 1/10..100 log xy to "log.tikz"' -e 'plot sin(1e4*x) vs x = 0..1 to "many.tikz"' \
    -e 'plot 5 + 1e-9*x^2 vs x = 0..1 to "near.tikz"' \
    -e 'coord x, y, z; particle p mass 1 at (x, y, z); potential (x^2 + 2*y^2 + 3*z^2)/2; start x = 1, y = 1/2, z'"'"' = 1' \
    -e 'run 0..3; plot p to "space.tikz"; sweep x = 1..2 count 3, y = 0..1 count 4 run 0..1 : value(x, 1)' \
    -e 'plot sweep1 to "map.tikz"; energy to "no.tikz"' 2>&1 | grep -v '^ \|^run'
# Labels that LaTeX reads otherwise.
qdot -q -e "$scene" \
    -e 'plot 1e-9*theta, 2*-x_max, theta^2^3, atan2(theta, x_max) labels "t in s", "a + b" title "|θ| < 1 − 2·k^2~" to "label.tikz"' \
    -e 'plot 1e-9*theta labels "", "a + b" to "brackets.tikz"' 2>&1 | grep -v '^ \|^run'
# A long path is drawn where the particle goes: on its circle, between the points too.
qdot -q -e "$scene" -e 'run 0..200; plot a to "long.tikz"' 2>&1 | grep -v '^ \|^run'
sed -n '/^ *(/s/[(),]/ /gp' long.tikz | awk '{ for (i = 1; i < NF; i += 2) {
        if (n++) { r = sqrt((x + $i)^2 + (y + $(i + 1))^2) / 2; far = 1 - r > far ? 1 - r : far }
        x = $i; y = $(i + 1) } }
    END { print (far < 0.01 && n > 300 ? "on the circle" : "off the circle by " far " with " n " points") }'
for name in phase key panels path log near space map label brackets; do
    echo "--- $name"
    # numbers that depend on the run's last digits are not compared
    sed -n '/^ *[^ (}]/p' $name.tikz | grep -v '^% ' | sed '/^  at\|[xyz]m[ai][nx]=\|height=\|meta m/d'
done
echo "$(grep -o '([0-9.e-]*,[-0-9.e]*)' many.tikz | wc -l) points" | sed 's/^2[0-9][0-9][0-9] /2000 and more /'
if kpsewhich pgfplots.sty >/dev/null 2>&1; then
    { printf '%s\n' '\documentclass{article}\usepackage{amsmath,pgfplots}\pgfplotsset{compat=1.16}\begin{document}'
    for name in phase key panels path log near many space map long label brackets; do printf '\\input{%s.tikz}\\par\n' $name; done
    printf '%s\n' '\end{document}'; } >all.tex
    pdflatex -interaction=nonstopmode all.tex >all.out 2>&1 || grep -A3 '^!' all.out
fi
