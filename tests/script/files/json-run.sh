# The fields of runs in JSON: done in parts, by digits, stopped, failed, with constraints; numbers N.
qdot -q --json - <<'SCENE' 2>/dev/null | sed 's/stopped at t = [^"]*/STOPPED/; s/\([:[,]"\{0,1\}\)-\{0,1\}[0-9][-+0-9.e]*/\1N/g'
coord x, y
particle a mass 1 at x
particle b mass 1 at y
potential x^2/2 + 900*y^2/2
start x = 1, y = 1
run 0..7 as a
run 0..1 digits 20 as b
value(b.x, 1)
value(a.x, a.y, 1)
event home: x = 0 stop
run 0..7 as c
home
reset
coord x, y
particle p mass 1 at (x, y)
constraint rod: x^2 + y^2 = 1
gravity (0, -1)
start x = 1
run 0..1 as d
event low: x = 0 stop
run 0..9 as f
remove low
start y = 0 exactly
run 0..1 digits 25 as h
reset
coord r > 0, phi
particle p mass 1 at (r*cos(phi), r*sin(phi))
potential -1/r^2
start r = 1
run 0..2 as e
SCENE
qdot -q --json -e 'coord x; particle a mass 1 at x; start x'"'"' = 1; run 0..2; check value(x, 1) == 2 within 1e-9' | tail -n 1
