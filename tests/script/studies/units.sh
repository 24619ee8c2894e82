# Slopes and multipliers do not depend on the units of length and time: a Mathieu equation at rest, a driven oscillator.
for unit in 1 1e-3 1e-9 1e5; do
    qdot -q - <<END 2>&1 | grep '^floquet' | sed 's/± [0-9.e-]*/± small/; s/\([0-9]\.[0-9]\{10\}\)[0-9]*/\1/g'
param s = $unit
coord x
particle p mass 1 at x
force -((1 + 0.3*cos(1.8*t/s))*x/s^2 + 0.05*x'/s) on x
start x = 0
run 0..pi*s/0.9
floquet
END
done
# d x(T)/d(x0, v0, k) in units of these: three numbers that are the same
for units in '1, 1' '1e-10, 1e-9' '1e3, 1e5'; do
    qdot -q - <<END 2>&1 | grep '^d(' | sed 's/± [0-9.e-]*/± small/; s/\([0-9]\.[0-9]\{10\}\)[0-9]*/\1/g'
param L = ${units%,*}, s = ${units#*, }, k = 1/s^2
coord x
particle p mass 1 at x
force -(k*x + x^3/(s*L)^2) on x
start x = L, x' = L/s/2
run 0..3*s
sensitivity value(x, 3*s) of x
sensitivity value(x, 3*s)/s of x'
sensitivity value(x, 3*s)/(L*s^2) of k
END
done
