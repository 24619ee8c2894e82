# A method that was named stays: where stability bounds its steps it says early that it would not
# arrive, and what would.
for method in taylor dop853 rk8pd rkf45 msadams; do
    printf "coord y
particle p mass 1 at y
gravity -9.81
force -1e8*y' on y
start y = 0
run 0..100 tol 1e-9 method $method
" | qdot -q --json - 2>/dev/null | sed -n 's/.*"reason":"stopped at t = [0-9.e-]*: \(.*\)steps of [^,]*, of which [^ ]* are left\([^"]*\)".*/'$method': \1steps of H, of which N are left\2/p'
done
# Friction in layers far narrower than a loose tolerance: steps jump from side to side of them.
for method in dop853 rkf45 msadams; do
    printf "coord x, y
particle p mass 1 at x
particle q mass 2 at y
potential x^2/2 + y^2/2 + (x - y)^2/2
force -tanh(1e8*x')/2 + sin(0.7*t) on x
force -0.3*tanh(1e8*y') on y
start x = 1, y = -1
run 0..20 tol 1e-4 method $method
" | qdot -q --json - 2>/dev/null | sed -n 's/.*"reason":"stopped at t = [0-9.e-]*: \(.*\)steps of [^,]*, of which [^ ]* are left\([^"]*\)".*/'$method': \1steps of H, of which N are left\2/p'
done
