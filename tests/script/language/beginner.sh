# A beginner's session: 120 statements, right ones and the natural mistakes; what each is answered, errors with the line
# that they lead to.
qdot --json -i 2>/dev/null <<'END'
coord theta
param m, l, g
particle bob mass m at (l sin(theta), -l cos(theta))
particle bob mass m at (l*sin(theta), -l*cos(theta))
gravity = (0, -g)
gravity (0, -g)
L
lagrangian
eom
eom theta
solve eom for theta''
theta'' = -g/l*sin(theta)
check theta'' = -g/l*sin(theta)
check eom[theta] == (theta'' = -g/l*sin(theta))
sin(theta) = 0
diff(V, theta) = 0
solve(diff(V, theta) = 0, theta)
theta = 1
theta' = 2
start theta = 1, theta' = 2
run 10
run 0..10
m = 1
set m = 1, l = 1, g = 9.81
run
run 0..10 tol=1e-9
run 0..10
theta(5)
value theta 5
value(theta, 5)
E
V = m*g*l*(1 - cos(theta))
T = 5
undo
hamilton
p_theta
lambda = 3
param lambda = 3
bob = (1, 2)
bob == (l*sin(theta), -l*cos(theta))
T == m*l^2*theta'^2/2
check energy conserved
check conserved energy
noether
equilibria
stability
period
T0 = 2*pi*sqrt(l/g)
numeric(T0)
find theta = 1, t2 = 2 such that theta(t2) = 0
find theta' = 1, t2 = 2 such that returns after t2
value(theta, 1) for l = [1, 2]
plot theta for l = [1, 2] to "pendula.svg"
plot theta for k = [1, 2]
table theta th
table theta for k = 1..3
print l for l = 1..3
print m*l for k = 1..3
for i = 1..3 print i
T for m = [1, 2]
theta^2 for theta = 1..2
run 0..1 for theta = [1, 2]
damping 0.1
friction = 0.1*theta'
dissipation = 0.1*theta'^2/2
dissipation 0.1*theta'^2/2
force = -0.2*theta' on theta
force -0.2*theta' on bob
remove friction
run(0..1)
run 0..1 until theta = 0
bounce: theta = 0 stop
reset
coord r > 0, phi
param k, m > 0
potential = -k/r
potential -k/r
particle planet mass m at (r*cos(phi), r*sin(phi))
lagrangian = m*r'^2/2
r = 1
set p_phi = 0.5
V_eff = p[phi]^2/(2*m*r^2) - k/r
plot V_eff
plot V_eff vs r from 0.1 to 5
plot r cos(phi), r sin(phi)
cyclic
param H = 2
Q = 3
coord p
undo
solve(r^2 = 2, r)
solve r^2 = 2
solve(cos(r) = r, r, 0..5)
solve(cos(r) = r, r = 1)
solve(sin(phi) = 0, phi, 0..10)
solve(exp(phi) + 1 = 0, phi)
solve([r + phi = 3, r - phi = 1], [r, phi])
solve([r^2 + phi^2 = 4, r*phi = 1], r, phi)
solve([r^2 + phi^2 = 4, phi = exp(-r)], [r = 1, phi = 1])
set k = 1, m = 1
equilibria
integrate(r^2, r)
taylor(sin(phi), phi, 5)
factor r^2 - 1
r^2 at r = 3
(1, 2) . (3, 4)
f(r) = r^2
f(2)
sin(r) = r^3
f(r, r') = r*r'
h(3) = 4
export eom to python
latex eom
save "orbit.csv"
help tol
help search drag
man
exit
x = 3
2x
END
echo "exit $?"
