# The tolerance of a run with signs of the screen is saved with it.
qdot -q <<'lag' >out.txt
param ep
coord x
particle p mass 1 at x
potential x²/2
set ep = 1e-8
start x = ½
run 0..½ tol ep
f(u) = sin (½ u)
save session to "kept.lag"
lag
grep -E '^(run|f)' kept.lag
