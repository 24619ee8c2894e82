# The rate of a state jumps where a table of steps does: z' = F(t) - z with F = 1/2 from 0.7 on, from z = 3/10.
printf 't,F\n0,0\n0.7,0.5\n3,0.5\n' >steps.csv
qdot -q - <<'EOF2' 2>&1
data F from "steps.csv" : t, F steps
state z' = F(t) - z
start z = 0.3
run 0..3
check value(z, 0.7) == 3/10*exp(-7/10) within 1e-14
check value(z, 3) == 1/2 + (3/10*exp(-7/10) - 1/2)*exp(-23/10) within 1e-14
EOF2
