# Bode diagrams: decibels and degrees over a logarithmic axis, in two panels. Numbers of the curves against those known:
# 1/(s^2 + s/10 + 1) has 20 dB and -90 degrees at 1, and falls by 40 dB in a decade; the phase does not wrap.
cat > scene.inc <<'END'
param m = 1, c = 0.1, k = 1
coord x
input F
particle a mass m at x
force F - c*x' on x
potential k*x^2/2
linearize at [x = 0]
END
qdot -q -e 'include "scene.inc"' -e 'plot bode transfer(F, x) for w = 0.1..100 keep to "one.svg"' \
    -e 'plot bode 1/s^2, (s - 1)/(s + 1) for w = 0.1..10 title "two" legend "mass", "delay" keep to "two.svg"' \
    -e 'plot bode 1/(s*(s + 1)*(s + 2)*(s + 3)) keep to "own.svg"' -e 'plot bode 1/(s^2 + 4)^2 to "axis.tikz"' \
    -e 'plot x vs x = 0..1 | plot bode 1/(s + 1) keep to "beside.svg"' | grep -c wrote
for name in one two own beside; do
    grep -E 'logscale|xrange|ylabel|ytics|title' $name.gp | sed "s/^/$name: /"
done
# the points of one.svg nearest to 1 and at the end: frequency, decibels; then frequency, degrees
awk 'BEGIN { block = 0 } NF < 2 { if (n > 0) block++; n = 0; next } !/^#/ { n++; d = $1 - 1; d = d < 0 ? -d : d
    if (!(block in near) || d < near[block]) { near[block] = d; at[block] = $2 }; last[block] = $2 }
    END { for (b = 0; b < 2; b++) printf "%.2f %.2f\n", at[b], last[b] }' one.dat
qdot -q -e 'include "scene.inc"' -e 'G = transfer(F, x)' -e 'subs(G, s = 2)' -e 'limit(G, s = 0)' -e 'diff(G, s)' \
    -e 'frequency_response(G, 1)' -e 'frequency_response((s + 1)/s, 2)' -e 'scene to "kept.lag"'
grep G kept.lag
