# How events end a run: stopped, a domain left, sliding; not by a contact that lasts, on walls that
# move either.
scene='param m = 1, g = 9.81
coord y
particle ball mass m at (0, y)
gravity (0, -g)
start y = 1
'
printf '%sevent land: y = 0 stop\nrun 0..3 as a\nland\nstart a\nstate = value(y, 0.1)' "$scene" |
    qdot -q --json - | sed 's/,"statement.*}/}/' | grep -o '"kind":"run".*"tol"\|"status".*\|"kind":"numbers".*'
printf '%sparam e = 0.5\nevent bounce: y = t/100 falling then y'"' = (1 + e)/100 - e*y'"'\nrun 0..10\n' "$scene" |
    qdot -q - 2>&1 | grep 'rests on\|failed'
printf 'coord y\nparticle p mass 1 at (0, y)\npotential y^2/2\nstart y = 1\nevent bounce: y = 0.2 + t/100 falling then y'"' = 3/200 - y'/2"'\nrun 0..10\n' |
    qdot -q - 2>&1 | grep 'rests on\|failed'
printf '%sevent bounce: y = t/100 falling then y'"' = 1/100"'\nrun 0..10\n' "$scene" | qdot -q - 2>&1 | grep 'rests on\|failed'
printf 'param m = 1\ncoord -1 < x <= 1\nparticle p mass m at (x, 0)\nstart x'"' = 1"'\nrun 0..3\n' |
    qdot -q - 2>&1 | grep failed
printf 'param m = 1\ncoord x <= 1\nparticle p mass m at (x, 0)\npotential x\nstart x'"' = 1.41422"'\nrun 0..3\n' |
    qdot -q - 2>&1 | grep failed
printf 'coord x, y\nparticle p mass 1 at (x, y)\nforce (1/2 - sign(x'"'"')*(2 + sign(y'"'"')), 1/2 - sign(y'"'"')*(2 + sign(x'"'"'))) on p\nstart x'"'"' = 1, y'"'"' = 1\nrun 0..30\n' |
    qdot -q - 2>&1 | grep failed
# a root at the very end lies before it or behind it: one occurrence, or none and a word of it
printf 'coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1\nevent e: x = 0\nevent far: x = 1/2\nrun 0..pi/2 method dop853\nevents\nrun 0..1.2\nevents\n' |
    qdot -q - 2>&1 | grep -c '^e\[1\]\|^e  at the end'
