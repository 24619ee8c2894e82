# Beyond x = 0 there is no y = sqrt(x): a run says where it came to its end, by whatever method, and in
# time.
for how in '' 'method rk8pd' 'method msadams' 'tol 1e-6'; do
    qdot -q - <<END 2>&1 | sed -n 's/.*error: the run failed: \(stopped at t = 0.61346\)[0-9]*: .*/\1/p'
coord x, y
particle p mass 1 at (x, y)
gravity (0, -1)
constraint root: sqrt(x) = y
start x = 1, y = 1, x' = -2
run 0..5 $how
END
done
# In all digits too: beyond it the equations of motion alone would go on. The time is that of the
# quadrature of sqrt((4 y^2 + 1)/(7 - 2 y)) over y = 0 to 1.
for how in 8 30; do
    qdot -q - <<END 2>&1 | sed -n 's/.*error: the run failed: //p'
coord x, y
particle p mass 1 at (x, y)
gravity (0, -1)
constraint root: sqrt(x) = y
start x = 1, y = 1, x' = -2
run 0..5 digits $how
END
done
