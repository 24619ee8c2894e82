# Arguments of integral() that are none, and integrals that have no value.
while read -r line; do
    qdot -q -e 'param x, a' -e "$line" 2>&1
done <<'EOF'
integral(x^2, 2)
integral(x^2, x, 1)
integral(x^2, x, 0, (1, 2))
integral(x^2)
integral(sqrt(x), x, -1, 1)
integral(1/x, x, 0, 1)
integral(1/x, x, -1, 1)
integral(1/x^2, x, -1, 1)
integral(tan(x), x, 0, pi)
integral(x, x, 0, infinity)
EOF
