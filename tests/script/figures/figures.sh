# What the options of `plot` do to the script that `keep` leaves, and names of files.
qdot -q - <<'EOF'
param c, V_0 = 2
coord theta1, theta2
particle a mass 1 at (sin(theta1), -cos(theta1))
particle b mass 1 at (sin(theta1) + sin(theta2), -cos(theta1) - cos(theta2))
gravity (0, -9.81)
start theta1 = 2, theta2 = 2
run 0..4 as one
plot theta1', theta2'' from 1 to 3 range -10..10 title "rates" labels "time in s", "1/s" keep to "rates.svg"
plot theta1' vs theta1, theta2' vs theta2 to "phase.svg" size 8.6, 6 keep
plot theta1 vs t keep to "course.png"
plot energy keep to "energy.svg"
plot drift(energy), drift(theta1) to "drift.svg" keep
plot a, b keep to "paths.pdf"
plot theta1 | plot V_0*theta2 | plot one.energy log x to "panels.svg" keep
plot c*exp(-x), V_0 vs x = 1/10..10 for c = [1, 2, 3] log xy keep to "exp.svg"
plot tan(x) vs x = 0..10 range -5..5 to "tan.svg" keep
reset
coord x, y, z
particle p mass 1 at (x, y, z)
potential (x^2 + 2*y^2 + 3*z^2)/2
start x = 1, y = 1/2, z' = 1
run 0..10
plot p keep labels "x in m", "y in m", "z in m" to "space.svg"
EOF
for name in rates phase course energy drift paths panels exp tan space; do
    echo "--- $name"
    # numbers that depend on the run's last digits are not compared
    sed -n 's/^set \(terminal [a-z@]*\).* size \([^ ]*\) .*/\1 \2/p
        /^set output/p; /^set title/p; /^set [xyz]label/p; /^set label/p; /^set logscale/p; /^set multiplot/p
        /^set size/p; /^unset [kx]/p; /^set view/p
        /^set [xyz]tics (/p
        /^s*plot/ { s/, /,\n/g; p; }' $name.gp |
        sed 's/\(energy\) − [0-9.]*/\1 − E/; s/(([$]2-([0-9.]*)/(($2-(E)/'
done 2>&1 | sed '/^--- energy/,/^---/ { /^set ytics/d; s/10^{−[0-9]*}/10^{N}/; s/1e-[0-9]*/1eN/; }
    /^--- drift/,/^---/ { /^set ytics/d; }; /^--- panels/,/^---/ { /10^{−1[0-9]}/d; /^set logscale/,/^plot/ { /^set ytics/d; }; }
    s/1:2:(\(-[0-9.]\{6\}\)[0-9]*)/1:2:(\1)/; s/^\(terminal .*cm,[0-9]*\.[0-9][0-9]\)[0-9]*cm/\1cm/'
# the data: one block a curve, named; enough points that no corner is seen, not many more
grep '^#' rates.dat exp.dat paths.dat
for name in rates exp tan space; do
    awk -v name=$name 'NF >= 2 && !/^#/ { n++ } END { print name, n > 100 && n < 5000 ? "has points" : n }' $name.dat
done
# gnuplot draws the same from the script that was left
mv rates.svg first.svg
gnuplot rates.gp 2>/dev/null && cmp rates.svg first.svg && echo same
# what a logarithmic axis leaves out is told; the 0 at which a drift begins is not
qdot -q -e 'plot x^3 vs x = -1..2 log y to "cubic.svg"'
qdot -q -e 'plot x^2 vs x = 0..2 log y to "square.svg"'
# figures without a name never overwrite one another
echo 'plot x vs x = 0..1' >named.lag
: >named-2.svg
for i in 1 2 3; do qdot -q named.lag; done
qdot -q -e 'coord x; plot x vs x = 0..1; plot x^2 vs x = 0..1 keep'
ls named* qdot-*
# a gnuplot that stops within the image leaves no file, and the one that was there
mkdir cut
printf '#!/bin/sh\n%s "$@" | head -c 500\n' "$(command -v gnuplot)" >cut/gnuplot
chmod +x cut/gnuplot
for name in cut.png cut.svg cut.pdf cut.gif; do
    echo old >$name
    case $name in
    *.gif) scene='coord x; particle p mass 1 at x; start x = 1; run 0..1; animate' ;;
    *) scene='plot x vs x = 0..1' ;;
    esac
    PATH=$PWD/cut:$PATH qdot -q -e "$scene to \"$name\"" 2>&1 >/dev/null | grep -o 'gnuplot stopped.*'
    cat $name
done
