# Curves that run to infinity are cut: the range of the ordinate is that of nine tenths of the curve and half as much on
# both sides. Narrow peaks, steps, steep ends and logarithms are shown whole, and `range` counts.
qdot -q -e 'plot tan(x) vs x = 0..10 keep to "tan.svg"' -e 'plot 1/x, x vs x = -1..1 keep to "both.svg"' \
    -e 'plot -1/sqrt(x) vs x = 0..1 keep to "root.svg"' -e 'plot exp(-(x - 0.3)^2*1e7) vs x = 0..1 keep to "peak.svg"' \
    -e 'plot exp(x^2) vs x = 0..10 keep to "steep.svg"' -e 'plot sign(x) vs x = -1..1 keep to "step.svg"' \
    -e 'plot log(x) vs x = 0..1 keep to "log.svg"' -e 'plot 1/x vs x = -1..1 range -5..5 keep to "said.svg"' \
    -e 'plot 1/x vs x = 0..1 log y keep to "powers.svg"' -e 'plot 1/(x - 1)^2 vs x = 0..3 keep to "square.svg"' \
    -e 'coord theta; particle p mass 1 at (sin(theta), -cos(theta)); gravity (0, -9.81); start theta = 1; run 0..6' \
    -e 'plot 1/theta keep to "run.svg"' | grep -c wrote
for name in tan both root peak steep step log said powers square; do
    echo "$name $(sed -n 's/^set yrange \[\(.*\):\(.*\)\]/\1 \2/p' $name.gp | awk '{ printf "%.3g %.3g", $1, $2 }')"
done
# where the steps of a run end, and so the points of its curve, depends on the processor
sed -n 's/^set yrange \[\(.*\):\(.*\)\]/\1 \2/p' run.gp | awk '{ print ($1 < -5 && $1 > -50 && $2 > 5 && $2 < 50 ? "run cut" : "run whole") }'
# the line does not go from one end of the figure to the other at a pole
awk '/^#/ || NF < 2 { last = ""; next } last != "" && $2*last < 0 && ($2 - last > 20 || last - $2 > 20) { n++ } { last = $2 } END { print n + 0 }' tan.dat
