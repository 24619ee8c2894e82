# What a table cannot be, where it ends, and what is not built with one.
printf 't,F\n0,1\n1,2\n2,0\n4,1\n' >d.csv
printf 't,F\n0,1\n2,2\n1,0\n' >down.csv
printf 't,F\n0,1\n1,2\n1,0\n' >twice.csv
printf 't,F\n0,1\n1,2\n2,0\n' >open.csv
printf 't,F\n0,1\n1,x2\n' >word.csv
printf 't,F\n0,1\n' >short.csv
printf '0,1,2\n1,2,3\n2,3,4\n' >three.csv
printf 'a,v,c\n0,0,1\n0,1,2\n1,0,3\n1,2,4\n' >scattered.csv
printf 'a,v,c\n0,0,1\n0,1,2\n1,0,3\n0,1,4\n1,1,4\n' >double.csv
while read -r line; do
    qdot -q -e "coord x; particle p mass 1 at x; start x = 0; $line" 2>&1
    echo "exit $?"
done <<'EOF2'
data
data d
data f from d.csv : t, F
data f from "d.csv"
data f from "d.csv" : t
data f from "d.csv" : t, F wavy
data f from "none.csv" : t, F
data f from "down.csv" : t, F
data f from "twice.csv" : t, F
data f from "word.csv" : t, F
data f from "short.csv" : t, F
data f from "three.csv" : t, F
data f from "open.csv" : t, F periodic
data f from "d.csv" : t, t
data f from "d.csv" : t^2, F
data f from "d.csv" : 3, F
data f from "scattered.csv" : a, v, c
data f from "double.csv" : a, v, c
data f from "three.csv" : a, v, c steps
data f from "three.csv" : a, v, c, e
data x from "d.csv" : t, F
data f from "d.csv" : t, F; set f(t) = t
data f from "d.csv" : t, F; numeric(f(5))
data f from "d.csv" : t, F; force f(t) on p; run 0..5
data f from "d.csv" : t, F; force f(t) on p; run -1..1
data f from "d.csv" : t, F; force f(x) on p; start x' = 2; run 0..5
data f from "d.csv" : t, F; force f(t) on p; run 0..3 digits 30
data f from "d.csv" : t, F; solve(f(t) = 1/2, t, 0..4)
data f from "d.csv" : t, F; numeric(integral(f(t), t, -1, 4))
data f from "d.csv" : t, F; numeric(integral(f(t^2), t, 0, 2))
data f from "d.csv" : t, F; numeric(integral(integral(f(t), t, 0, s), s, 0, 2))
data f from "d.csv" : t, F; function f(t)
data f from "d.csv" : t, F; force f(2*t + 1) on p; run 0..5
data f from "d.csv" : t, F; force if(t < 3, f(t), 0) on p; run 0..5
data f from "d.csv" : t, F; force f(t) on p; event near: x = 1 rising stop; run 0..5
data f from "d.csv" : a, v, c periodic
data f from "d.csv" : t, F steps; state z' = f(t) - z; run 0..3 method radau
data f from "d.csv" : t, F linear; state z' = x*f'(t) - z; run 0..3
EOF2
