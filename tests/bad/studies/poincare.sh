# Sections that cannot be: where, and why.
scene='coord x, y; param k; particle b mass 1 at (x, y); potential x^2/2 + y^2'
while read -r line; do
    qdot -q -e "$scene" -e 'start x = 1' -e "$line" 2>&1 | sed '/^run/,/y = /d; s/undefined at t = .*/undefined at t = T/'
done <<'EOF'
poincare x = 0 : y
poincare x : y
poincare x = 0 y
poincare x = 0 rising falling : y
poincare (x, y) = 0 : y
poincare x = 0 :
poincare x = 0 : y, (x, y) run 0..1
poincare x = 0 : z run 0..1
poincare x = 0 : k*y run 0..1
poincare x = 0 : y of curve
poincare x = 0 : y run 0..1 of curve
poincare x = 0 : y run 0..1 run 0..2
poincare x = 0 : y from 1 run 0..1
poincare x = 0 : y run 0..1 as x
poincare log(x) = 0 : y run 0..10
poincare x = 0 : y run 0..1 digits 20
poincare x = 0 : log(y - 5) run 0..3
EOF
