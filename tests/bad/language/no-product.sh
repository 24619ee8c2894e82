# Behind a name or a word of the statement no `*` is missing; a function without its argument is told as that.
for line in 'export C eom to "e.c"' 'run 0..1 with m = 2, tol 1e-9' 'start run1 x = 2' \
    "poincare x = 0 run 0..20 method taylor x'" 'fit m to "a" : t, x, sigma 0.1' \
    'sweep m = 2*[1, 2] run 0..10 : x' 'sweep m = 1..3 by 1 run 0..1 : x' 'sweep m = A run 0..1 : x' \
    'A = [1, 2]; sweep m = A run 0..1 : x' 'sweep m = 2 run 0..1 : x' \
    'sweep m = 1..3 step 1, run 0..1 : x' 'sweep m = normal(1, 0.1), m = 1..2 step 1 count 2 run 0..1 : x' \
    'sin x == 1' 'check if x == y' 'if m == 1 then run 0..1' 'check x == 2 x' 'run 0..1 tol 2 m'; do
    qdot -q -e "param m = 1; coord x; lagrangian m*x'^2/2 - x^2/2; start x = 1; $line"
done 2>&1
