# An export has the velocities that a start by speeds gives.
cat > s.lag <<'L'
param a = 2
coord x, y
particle b mass 1 at (x, y)
potential x^2 + y^2
speed u = x', v = x' + y'
start u = a, x = 0.1
export python eom to "x.py"
L
qdot -q s.lag
grep '^START' x.py
