# Infinity is no value of a parameter, a coordinate or a speed, no bound that would exclude everything, and no side of an equation to solve.
for line in 'set k = infinity' 'start x = infinity' 'param c = infinity' 'param c > infinity' 'assume k < infinity' \
    'solve(x = infinity, x)' 'run 0..infinity' 'gravity (0, -infinity)'; do
    qdot -q -e "param m, k; coord x, y; particle p mass m at (x, y); $line"
    echo "exit $?"
done 2>&1
qdot -q -e 'coord 0 < r < infinity, -infinity < s; scene' 2>&1
