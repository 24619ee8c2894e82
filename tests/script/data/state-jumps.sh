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
# Steep lines are no jump: a ramp of 1e-3 to 20.
printf 't,F\n0,0\n1,0\n1.001,4\n3,4\n' >ramp.csv
qdot -q - <<'EOF2' 2>&1
data F from "ramp.csv" : t, F linear
state z' = 5*F(t) - z
run 0..3
check value(z, 1.001) == 20000*(1/1000 - 1 + exp(-1/1000)) within 1e-12
check value(z, 3) == 20 - (20 - 20000*(1/1000 - 1 + exp(-1/1000)))*exp(-1999/1000) within 1e-12
EOF2
