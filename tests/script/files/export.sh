# export: what is written, and what is refused. tests/meta/exports.test compiles and runs it.
cat >scene.lag <<'END'
param m, L, g > 0, tau
coord theta
particle bob mass m at (L*sin(theta), -L*cos(theta))
gravity (0, -g)
torque tau on theta
set m = 1, L = 2, g = 9.81
start theta = 2
END
qdot -q scene.lag - <<'END'
export c eom to "pendulum.c"
export python eom to "pendulum.py"
export julia T + V to "energy.jl"
export octave eom to "pendulum.m"
export c theta'*L to "speed.c"
export python [theta = 1, 2*theta] to "list.py"
export matlab pi to "number.m"
END
cat pendulum.py
sed -n '/^void pendulum_equations.*)$/,/^}/p' pendulum.c
cat energy.jl speed.c list.py number.m
qdot -q scene.lag -e 'export c eom to "x.py"'
qdot -q scene.lag -e 'export fortran eom to "x.f"'
qdot -q scene.lag -e 'export c eom'
qdot -q scene.lag -e 'export matlab eom to "2-x.m"'
qdot -q scene.lag -e 'function F(s); export c F(theta) to "x.c"'
qdot -q scene.lag -e 'export python "text" to "x.py"'
qdot -q -e 'export c eom to "x.c"'
qdot -q scene.lag -e 'export c eom to "nowhere/x.c"'
qdot -q -e 'coord x, y; particle a mass 1 at (x, y); constraint one: x = t; constraint two: 2*x = 2*t; export c eom to "x.c"'
# the ends of a domain are events; the run's values, tolerance and time
qdot -q -e 'param k; coord r > 1; lagrangian r'"'"'^2/2 - k*r; start r = 2; run 0..1 tol 1e-10 with k = 0.5; export c eom to "end.c"'
grep -E 'event_names|_span.2. =|\.k = ' end.c
