# A table that only d'Alembert's residual reads: of a long chain M and f are not derived. Runs end their steps at its knots,
# a sweep makes its runs alone, and a run that comes to its end says so.
printf 't,F\n0,1\n0.3,-2\n0.5,1.5\n0.8,0\n' >wind.csv
cat >chain.lag <<'EOF2'
coord phi[j] for j = 1..40
param g = 9.81
particle b[i] mass 1 at (sum(sin(phi[j]), j, 1, i), -sum(cos(phi[j]), j, 1, i)) for i = 1..40
gravity (0, -g)
data wind from "wind.csv" : t, F
force (wind(t), 0) on b[40]
start phi[1] = 0.5
EOF2
qdot -q chain.lag -e 'plan sweep g = 9..10 step 0.02 run 0..0.7 : phi[1]' | grep '^each'
qdot -q chain.lag -e 'run 0..1' 2>&1 >/dev/null
