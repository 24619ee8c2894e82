# Slopes of Lagrangians in phase space, p q' - H, where the equation of q determines p'. Closed forms: cos(10), sin(10),
# -0.3/cos(10), 2 pi; cos(6), sin(6)/2, -3 sin(6)/4, cos(3).
qdot -q - <<END 2>&1 | sed 's/ ± .*//; s/\([0-9]\.[0-9]\{8\}\)[0-9]*/\1/'
coord q, p
lagrangian p*q' - (p^2/2 + q^2/2)
start q = 1/2
sensitivity value(q, 10) of q, p
find q = 0.4 such that value(q, 10) = -0.3
find T = 6 such that returns after T
reset
param k
coord p, x, q
lagrangian p*q' - p^2/2 - k*q^2/2 + x'^2/2 - x^2/2
set k = 4
start q = 1, x = 1
sensitivity value(q, 3) of q, p, k
sensitivity value(x, 3) of x
END
