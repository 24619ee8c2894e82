# Errors of expressions that are singular at a bounce, read elsewhere: those of the state, not those of the pole. A ball from
# y = 1 at g = 10 bounces at t1 = sqrt(1/5) with 0.8 of its speed: at 0.8 it is at y with y'.
qdot -q - <<'END' | awk 'BEGIN { t1 = sqrt(0.2); v = 0.8*sqrt(20); s = 0.8 - t1; y = v*s - 5*s*s; u = v - 10*s
    truth[1] = u/y; truth[2] = 1/y; truth[3] = log(y); truth[4] = 1/y^2; truth[5] = atan2(u, y)
    v *= 0.8; s = 1.2 - t1 - 1.6*t1; truth[6] = 1/(v*s - 5*s*s) }
/^value/ { n++; name = $0; sub(/ = .*/, "", name); value = $0; sub(/.* = /, "", value); error = value
    sub(/.* ± /, "", error); value += 0; error += 0; off = value - truth[n]; off = off < 0 ? -off : off
    size = truth[n] < 0 ? -truth[n] : truth[n]
    print name, off <= error + 1e-14*size ? "within its error" : "off by " off/error " errors",
          (0 < error && error < 1e-12*size) ? "" : "which is large: " error }'
param g = 10
coord y
particle b mass 1 at (0, y)
gravity (0, -g)
event hit: y = 0 falling then y' = -0.8*y'
start y = 1
run 0..1.5
value(y'/y, 0.8)
value(1/y, 0.8)
value(log(y), 0.8)
value(1/y^2, 0.8)
value(atan(y'/y), 0.8)
value(1/y, 1.2)
END
