# What a function is not defined for.
for text in 'k(v) = v[1]; k(3)' 'k(v) = v[1]; k([1, 2; 3, 4])' 'k(v) = v[4]' 'k(v) = cross(v, (1, 0, 0)); k((1, 2))' \
    'h(u, w) = u + w; h(1, (1, 2))' "k(v) = v[2]; k'(1)" 'f(a, b, c, d) = a + b; f((1, 2), (2, 3), 1, 1)' \
    'param v[k] = 3 for k = 1..2; g(v) = v[1]; g(2)'; do
    qdot -e "$text"
    echo "exit $?"
done
