# Arguments of integral() that are none.
while read -r line; do
    qdot -q -e 'param x, a' -e "$line" 2>&1
done <<'EOF'
integral(x^2, 2)
integral(x^2, x, 1)
integral(x^2, x, 0, (1, 2))
integral(x^2)
integral(sin(x)/x, x)
integral(sqrt(x), x, -1, 1)
integral(x == 1, x)
EOF
