qdot - <<'END' | sed -E 's/^ *([24]\.[24][0-9]{8})[0-9]* +1$/\1  1/'
# A sign that changes through infinity is no moment of equality.
coord x
particle p mass 1 at x
potential x^2/2
start x = 1
event zero: tan(t) = 0
run 0..7
events
check zero[1] == pi within 1e-14
check zero[2] == 2*pi within 1e-14
poincare tan(t) = 0 : x

# A body that falls into the centre is fastest there; it is at rest where it began alone.
reset
coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 1
event turns: x' = 0
run 0..5
events
poincare x' = 0 : x
END
