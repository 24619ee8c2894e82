# What errors say of slips of the pen: each alone, with its hint.
say()
{
    qdot -e "$1" 2>&1
    echo "exit $?"
}
say 'for k = 1..3'
say 'k for k'
say 'k for k = 1'
say 'k for k = 1..2 for j = 1..2'
say 'a[k] = a[k-1]*2 for k = 1..3'
say 'b = b + 1'
say 'param pi > 2'
say 'param m, t'
say 'param 2'
say 'param a b'
say 'param m; coord x m'
say 'function f'
say "coord x; x'(t)"
say 'coord x; x(2)'
say 'coord x; x – 1'
say '\theta'
say 'coord x; x := 2'
say 'coord x; particle b mass 1 at x; spring s between b stiffness 1'
say 'coord x; series(x^2, x, 2)'
say 'coord x; subs(x, 2)'
say 'coord x; diff(x)'
say 'coord x; sin(u) = 3; sin(2)'
say "coord x; particle b mass 1 at x; T'"
say 'coord x; x to'
say 'coord x; x to "a.foo"'
say 'coord x; x to "a.h5"'
say 'help taylor; show pi; show t'
say 'coord x, y, a; body b mass 1 inertia 2 about (1, 2) at (x, y) angle a'
say 'coord x, y, a; body b mass 1 inertia -2 at (x, y) angle a'
