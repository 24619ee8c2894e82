# both sides of an event in a file; the parameters of a sweep in its file
cat >scene.lag <<'END'
param g = 9.81, m > 0, twice
set m = 2, twice = 2*m
coord y
particle b mass m at y
potential m*g*y
event hit: y = 0 falling then y' = -0.5*y'
start y = 1
run 0..1 as a
save a to "a.csv"
sweep m = 1..2 step 0.5 run 0..0.4 with g = 9 : value(y, 0.4) as S
save S to "S.json"
param k > 0
set k = 3
reset scene
coord x
lagrangian x'^2/2 - x^4/4 - k*g*x^2/2
continue equilibria in g = -1..1
save branches to "branches.json"
END
qdot scene.lag >out || cat out
grep -c . a.csv
# v before and after the bounce: half of it, and turned
awk -F, 'NR > 2 && $1 == t { printf "%.12f\n", $3 / v } { t = $1; v = $3 }' a.csv
grep '^"parameters"' S.json branches.json
