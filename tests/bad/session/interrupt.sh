# Ctrl-C during long computations: each says so and ends with status 1; a run so far is kept (11).
cd "$(mktemp -d)" || exit 1
while IFS='|' read -r name text; do
    printf '%b\n' "$text" >long.lag
    timeout --foreground --preserve-status -k 20 -s INT 1 qdot -q long.lag >out 2>&1 </dev/null
    echo "$name: exit $?, $(grep -c ': error: interrupted$' out)$(grep -c 'failed: interrupted$' out)"
done <<'END'
a loop|x = k for k = 1..9*10^6
a block|{ x = k; y = x } for k = 1..9*10^6
a sum|sum(1/k, k, 1, 10^6)
derivatives|param x\ndiff(sin(x)*exp(x)*log(x)*tan(x), x, 100000)
powers|param x\ndiff(x^x, x, 300)
functions|f(n) = if(n < 2, n, f(n-1) + f(n-2))\nf(40)
a run|coord x\nparticle p mass 1 at x\npotential x^2/2 + x^4\nstart x = 1\nrun 0..10^6 method rk8pd
constraints|coord x, y\nparticle p mass 1 at (x, y)\nconstraint c: x^2 + y^2 = 1\ngravity (0, -1)\nstart x = 1\nrun 0..10^7
with events|coord x, y\nparticle p mass 1 at (x, y)\nconstraint c: x^2 + y^2 = 1\ngravity (0, -1)\nstart x = 1\nevent e: y = -1/2 then x' = x'\nrun 0..10^7
a start|coord x[k], y[k] for k = 1..200\nparticle p[k] mass 1 at (x[k], y[k]) for k = 1..200\nconstraint c[k]: (x[k]-x[k-1])^2 + (y[k]-y[k-1])^2 = 1 for k = 2..200\nstart x[k] = k/3, y[k] = -k*9/10 for k = 1..200\nrun 0..1
a factorisation|coord x[k] for k = 1..1200\nparticle p[k] mass 1 at x[k] for k = 1..1200\nconstraint c[k]: x[k]^2 = x[k-1]^2 for k = 2..1200\nstart x[k] = 1 for k = 1..1200\nrun 0..100
a plot|param y\nplot c*y vs y = 0..3 for c = 1..9*10^6 to "x.svg"
a table|coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1\nrun 0..10 method rk8pd\n{ table x every 0.001 to "x.csv" } for k = 1..10^6
END
rm -rf "$PWD"
