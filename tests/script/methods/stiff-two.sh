#!/bin/sh
# A stiff force under the tightest tolerance: first orders in two doubles do not fit to the others
# there, and the run is made in doubles, whose rounding dies out; else nearly all steps are taken back.
qdot -q --json - <<'END' | sed -n 's/.*"steps":\([0-9]*\),"rejected":\([0-9]*\).*"error":\([^,]*\),.*/\1 \2 \3/p; s/.*"verdict":\("[a-z]*"\).*/\1/p' |
coord x, y
particle bob mass 1 at (x, y)
spring s between bob, (0, 0) stiffness 4000000 rest 1
damper d between bob, (0, 0) coefficient 5000
gravity (0, -9.81)
start x = 1.005, y = 0
run 0..3 tol 1e-15 as a
run 0..3 digits 18 as b
check value(a.x, 3) == value(b.x, 3) within 3e-14
check value(a.y, 3) == value(b.y, 3) within 3e-14
END
    awk 'NR == 1 { print ($2 < $1/2 ? "few" : $2), "rejected, error", ($3 < 1e-12 ? "good" : $3) } NR > 2'
