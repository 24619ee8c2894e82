# Words of the language that come later say so, each at its place.
scene='coord x, y; param mu, k; particle b mass 1 at (x, y); constraint floor: y = 0'
while read -r line; do
    qdot -q -e "$scene" -e "$line" 2>&1 | sed -n '1p;2p'
done <<'EOF'
run 0..1 method gauss4
EOF
