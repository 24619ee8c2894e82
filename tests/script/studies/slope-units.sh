# Slopes in the units of the scene stay within their errors, which are small beside them: of a fast and large oscillator, and
# of bounces from rest within 1.5 s and within 1.5e-18 s.
qdot -q - <<'END' | awk 'BEGIN {
    s = sqrt(0.2); e = 0.8; v = e*sqrt(20); T = 1.5
    truth[1] = 2.601071573142317402e-9; truth[2] = -2.108806895639376297
    for (k = 0; k < 2; k++) {
        u = k == 0 ? 1 : 1e-18
        truth[3 + 3*k] = -s/20*u; truth[4 + 3*k] = -(1 + 2*e)*s/20*u; truth[5 + 3*k] = -0.0382709629351022075
    } }
/^d\(/ { name = $0; sub(/ = .*/, "", name); value = $0; sub(/.* = /, "", value); error = value
    sub(/.* ± /, "", error); value += 0; error += 0; n++; off = value - truth[n]; if (off < 0) off = -off
    size = truth[n] < 0 ? -truth[n] : truth[n]
    print name, off <= error + 5e-16*size ? "within its error" : "off by " off/error " errors",
          (0 < error && error < 1e-13*size) ? "" : "which is large: " error }'
param m = 0.1, k = 1.5876e17
coord x
particle b mass m at x
potential k*x^2/2
start x = 1.61e8, x' = 8.3e16
run 0..4.57e-9
sensitivity value(x, 4.57e-9) of k
sensitivity value(x', 4.57e-9) of k
reset
param g = 10, u = 1
coord y
particle b mass 1 at (0, y)
force (0, -g/u^2) on b
event hit: y = 0 falling then y' = -0.8*y'
start y = 1
{ set u = U; run 0..1.5*U; sensitivity hit[1] of g; sensitivity hit[2] of g; sensitivity value(y, 1.5*U) of g } for U = [1, 1e-18]
END
