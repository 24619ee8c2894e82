# Equations that switch by what a table of data holds: steps jump over a threshold or to it, lines stay at it for a while.
# A force 1 acts as long as the condition holds, so x' is that time; a body sticks until a jump of the force pulls it loose.
printf 't,F\n0,0\n1,1\n2,0\n3,1\n4,0\n5,0\n' >gate.csv
printf 't,F\n0,0\n1,0\n1.5,1\n2.5,1\n3,0\n4,0\n4.2,1\n5,1\n' >ramp.csv
printf 't,F\n0,0\n1,0.5\n2,2\n3,0.2\n4,-1\n5,0\n' >pull.csv

scene() { # kind, file, condition, end of x'
    cat <<EOF
reset
data g from "$2" : t, F $1
coord x
particle p mass 1 at x
force $3 on p
start x = 0
run 0..5
check value(x', 5) == $4 within 1e-13
EOF
}

{
    scene steps gate.csv 'if(g(t) > 0, 1, 0)' 2
    scene steps gate.csv 'if(g(t) >= 1, 1, 0)' 2
    scene steps gate.csv 'if(g(t) < 1, 1, 0)' 3
    scene steps gate.csv 'if(g(t) == 1 and t < 3.5, 1, 0)' 1.5
    scene steps gate.csv 'max(g(t), 0.5)' 3.5
    scene steps gate.csv 'abs(g(t) - 0.3)' 2.3
    scene steps gate.csv 'g(t)*sign(g(t) - 0.5)' 2
    scene linear ramp.csv 'if(g(t) >= 1, 1, 0)' 1.8
    scene linear ramp.csv 'if(g(t) > 0, 1, 0)' 3
    scene linear ramp.csv 'if(g(t) <= 0, 1, 0)' 2
    scene linear ramp.csv 'if(0.3*g(t) >= 0.3 and t < 3.5, 1, 0)' 1
    scene linear ramp.csv 'sign(g(t) - 1)' -3.2
    cat <<'EOF'
reset
data g from "pull.csv" : t, F steps
state z' = max(g(t), 1)
start z = 0
run 0..5
check value(z, 5) == 6 within 1e-13
reset
data g from "pull.csv" : t, F steps
coord x
particle p mass 1 at x
force g(t) - x - sign(x')/2 on p
event half: g(t) = 2
start x = 0
run 0..5
check value(x, 3) == 1.5*(1 - cos(1)) within 1e-13
events
EOF
} >switches.lag
qdot -q switches.lag 2>&1 | grep -v '^  \|^run'
