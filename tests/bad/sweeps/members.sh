# Values along runs where they have none: in the scene, in derivatives, as numbers; two runs at once.
scene='param k = 1; coord x; particle p mass 1 at x; potential k*x^2/2; start x = 1; run 0..1 as a; run 0..2 as b'
while read -r line; do
    echo "> $line"
    qdot -q -e "$scene" -e "$line" 2>&1 | sed '1,/x = .*x. = /d' | sed '1,/x = .*x. = /d'
done <<'EOF'
potential a.x
force a.x on x
particle q mass a.x at x
constraint x = a.x
event z: a.x = 0
start x = a.x
param u = a.x
set k = a.x
run 0..a.x
ddt(a.x)
diff(a.x - b.x, x)
solve(a.x = k, k)
d = a.x; d'
check a.x == b.x within 1e-3
plot a.x vs x = 0..3 to "x.svg"
a.(b.x)
if(a.(x > 0), 1, 2)
max(a.x - b.x, 0..2)
min(1/(a.x - 1/2*b.x'), 0..1)
max(1/(a.x + b.x - 9/5), 0..1)
mean(1/(a.x + b.x - 9/5), 0..1)
mean(log(a.x + b.x - 9/5), 0..1)
max(a.x - nothing.x, 0..1)
EOF
