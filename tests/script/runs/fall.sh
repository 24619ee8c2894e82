# Tables and figures of a run that is known exactly, and what is in their files.
qdot -q - <<'END' | sed '/^  /d'
param m, g > 0
coord y
particle p mass m at y
gravity -g
set m = 1, g = 2
start y = 10, y' = 1
run 0..2 tol 1e-12 method rk8pd as a
check value(y, 2) == 8 within 1e-12
check value(a.(y + y'), 1) == 9 within 1e-12
table y, a.y' every 1 to "fall.csv"
table y every 1/2 to "fall.txt"
save a to "whole.csv"
plot y, y' to "fall.svg"
plot y' vs y
plot p, y to "p.svg"
plot c*y^2 vs y = 0..3 for c = [1, 2, 3]
plot u^2 + k vs u = -1..1 for k = 1..2 to "u.svg"
END
head -n 1 fall.csv fall.txt whole.csv
awk -F, '{ printf "%.6f %.6f %.6f\n", $1, $2, $3 }' fall.csv | tail -n 3
awk '{ printf "%.6f %.6f\n", $1, $2 }' fall.txt | tail -n 5
for figure in fall qdot-1 qdot-2 p u; do grep -c '<path' $figure.svg | sed 's/^0$/empty/; s/^[1-9].*/curves/'; done
