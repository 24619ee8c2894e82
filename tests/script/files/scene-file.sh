# `scene to`: read in a fresh program it gives the same scene, and written again the same file.
n=0
for script in assumed.lag bodies-moved.lag conserved.lag constraint-switches.lag declarations.lag \
    definitions.lag equilibria.lag events.lag flexing.lag force-material.lag function-calculus.lag \
    functions.lag geometry.lag hamilton.lag labels.lag loops.lag mechanism-*.lag moving.lag \
    names.lag numeric.lag order.lag parts.lag poisson.lag reactions.lag reset.lag routh.lag \
    signs.lag start-consistent.lag values.lag vector-functions.lag; do
    rm -f first.lag second.lag
    qdot -q "$script" -e 'scene to "first.lag"' >/dev/null 2>&1
    [ -f first.lag ] || { echo "$script: not written"; continue; }
    qdot -q first.lag -e 'scene to "second.lag"' >said 2>&1 || cat said
    cmp first.lag second.lag || diff first.lag second.lag | head -n 5
    n=$((n + 1))
done
[ $n -gt 30 ] && echo 'many scripts'

# Equations, energies and the end of a run, to the last bit.
cat >scene.lag <<'END'
function w(x, t), f(s)
param m, L > 0, big = 123456789012345678901234567890/11, 0 < c <= 1, g = 9.81
coord x, -9 < theta <= 3*pi
param unit
assume m > c
R = (x + L*sin(theta), -L*cos(theta))
u(q) = diff(q, x) + sum(j*q, j, 1, 3)
particle cart mass m at (x, 0)
particle bob mass 1/3 at R
gravity (0, -g)
spring s1 between cart, (0, 0) stiffness 1e-3*m rest 0.1
damper between bob, cart coefficient c
potential well: w(x, t)*m
dissipation c*x'^2/2
force push: (cos(t), 0) on bob
torque -c*theta' on theta
event up: theta = 2 rising
event hit: x = 1 rising then x' = -c*x', theta' = 2*theta'
G = metric(R)
H0 = hamiltonian
E0 = (x = 2*theta + 1)
set m = 2/3, L = 1.1, c = 0.3, unit = m*c^2
set w(a, b) = a^2*sin(b)
start theta = 1, x' = 1e-20 + 1/3 exactly
END
ask='T; V; energy; eom; forces; H0; E0; u(x^2); G[x, theta]; unit; print big, c; numeric(big); events
run 0..3 as a'
qdot -q scene.lag -e 'scene to "written.lag"'
qdot --json scene.lag -e "$ask" | sed 's/"cpu[a-z_]*":[^,]*,//g; s/,"statement.*//' >one
qdot --json written.lag -e "$ask" | sed 's/"cpu[a-z_]*":[^,]*,//g; s/,"statement.*//' >two
cmp one two && grep -c . two
cat written.lag

# A session has its style and its runs; the scene is written in the plain style.
qdot -q written.lag -e 'style unicode; run 0..1/2 tol 1e-9 as a with c = 1/4; run 0..1
scene to "again.lag"; save session to "session.lag"; style latex; save session to "session.lag"' |
    grep -v 'cpu'
cmp written.lag again.lag && diff again.lag session.lag
qdot -q session.lag -e 'style plain; scene to "again.lag"' && cmp written.lag again.lag

# A name with a number of a run is no part of a scene; what somebody wrote stays.
qdot -q -e "coord x; lagrangian x'^2 - x^2; start x = 1; 1; run 0..1; B = value(x, 1); start run1
A = sin(x); sin = 3; G[k] = metric((k*x, 1)) for k = 1..2; c[k] = %1 + k for k = 1..2
scene to \"other.lag\"" | tail -n 2
cat other.lag
qdot -q -e "coord x; particle a mass 1 at x; A = hamiltonian; remove a; scene to \"other.lag\""
cat other.lag
echo 'coord mine' >mine.lag
qdot -q -e 'coord x; scene to "mine.lag"'
cat mine.lag
qdot -q -e 'scene to "no/such/place.lag"'
qdot -q -e 'scene to'
qdot -q -e 'scene to "a.tex"; scene to x'
qdot -q -e 'save session to "a.svg"'
qdot --json -e 'coord x; scene to "an-object.lag"; undo'

# Into a pipe it is written for whom reads there.
mkfifo pipe.lag
timeout 60 cat pipe.lag >read.lag &
timeout 60 qdot -q -e 'coord x; scene to "pipe.lag"'
wait
cat read.lag
