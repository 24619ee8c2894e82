# Slopes of the times of bounces stay within their errors: of a ball thrown up at v from height h bounce k is at
# (v + s + 2 s (e + ... + e^(k-1)))/g, s = (v^2 + 2 g h)^(1/2). Slopes are read a little before the event, which they change
# on the way to.
qdot -q - <<'END' | awk '/^d\(/ {
    split($1, part, /[][()\/]+/); k = part[3]; by = part[5]; value = $3; error = $5
    g = 9.81; h = 1.3; v = 0.7; e = 0.8; s = sqrt(v*v + 2*g*h); E = 0; E1 = 0
    for (i = 1; i < k; i++) { E += e^i; E1 += i*e^(i - 1) }
    if (by == "g") truth = h/s*(1 + 2*E)/g - (v + s*(1 + 2*E))/g^2
    if (by == "h") truth = (1 + 2*E)/s
    if (by == "v") truth = (1 + v/s*(1 + 2*E))/g
    if (by == "e") truth = 2*s*E1/g
    off = value - truth; if (off < 0) off = -off; size = truth < 0 ? -truth : truth
    print $1, off <= error + 5e-16*size ? "within its error" : "off by " off/error " errors",
          error < 1e-13*(size + 1) ? "" : "which is large: " error }'
param g = 9.81, h = 1.3, v = 0.7, e = 0.8
coord y
particle ball mass 1 at (0, y)
gravity (0, -g)
event hit: y = 0 falling then y' = -e*y'
start y = h, y' = v
run 0..4
sensitivity hit[1] of g, h, v, e
sensitivity hit[2] of g, h, v, e
sensitivity hit[5] of g, h, v, e
run 0..4 method dop853
sensitivity hit[2] of g, h, v, e
sensitivity hit[5] of g, h, v, e
END
