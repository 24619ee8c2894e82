#!/bin/sh
# A spring of 1e8, 1e4 rad/s, swung by the weight: 1e-7 long, 1e-3 fast, 9.8 in accelerations. radau at 1e-4 goes over
# that in steps of three periods, and so do its companions; the errors of what is read hold it all the same.
qdot -q --json - <<'END' | sed -n 's/.*"name":"value.*"value":\([^,]*\),"error":\([^,]*\),.*/\1 \2/p' |
coord x, y
particle p mass 1 at (x, y)
spring s between p, (0, 0) stiffness 1e8 rest 1
gravity (0, -9.81)
start x = sin(1), y = -cos(1)
run 0..10 tol 1e-13 method taylor as exact
run 0..10 tol 1e-4 method radau as far
value(far.x'' - exact.x'', 3)
value(far.x' - exact.x', 3)
value(far.y'' - exact.y'', 7.1)
value(far.y' - exact.y', 7.1)
END
    awk '{ off = $1 < 0 ? -$1 : $1
           print (off <= $2 ? "within" : off " beyond"), (off > 1e-5 && $2 > 100*off ? $2 " overstated" : "what is stated") }'
