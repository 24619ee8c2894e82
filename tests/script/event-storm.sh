# An event that comes a thousand million times a second ends the run, with place and rate; one that
# comes ten thousand times in all does not.
for shift in 1e-9 1e-4; do
    printf "coord x
particle p mass 1 at x
event a: x = 1 rising then x = 1 - $shift
start x = 1 - 2*$shift, x' = 1
run 0..2 tol 1e-9
" | qdot -q --json - 2>/dev/null | sed -n 's/.*"reason":\(null\|"[^"]*"\).*/\1/p'
done
