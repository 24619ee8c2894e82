# Where T - V jumps across a surface the force is infinite, though the equations on its sides may
# be the same: the run stops there and says so. What is continuous, or jumps in time, or where an
# event says what happens, goes on; but a momentum that would jump in time stops it too.
scene='coord x
particle p mass 1 at x
'
run()
{
    printf "%s$1\n" "$scene" | qdot -q --json - 2>/dev/null |
        sed -n 's/.*"t":\(\[[^]]*\]\).*"status":\("[^"]*"\),"reason":\(.*\),"statement.*/\1 \2 \3/p'
}
run 'potential if(x > 0, 0, 1)\nstart x = -1, x'\'' = 1\nrun 0..5'
run 'potential floor(x) + x\nstart x = 1/2, x'\'' = 2\nrun 0..5'
run 'potential sign(x)\nstart x = -1, x'\'' = 3\nrun 0..5 method dop853'
run 'remove p\nlagrangian x'\''^2/2*if(x < 1, 1, 2)\nstart x = 0, x'\'' = 1\nrun 0..4'
run 'potential abs(x) + max(x, 1)^2\nstart x = -1\nrun 0..4'
run 'potential if(t > 1, x^2, 0)\nstart x = 1\nrun 0..4'
run 'potential if(x > 0, 0, 1)\nstart x = -1, x'\'' = 1\nevent wall: x = 0 rising then x'\'' = -x'\''\nrun 0..5'
# Momenta at switches of time alone: a support whose velocity jumps, a mass, a magnetic term.
scene='coord x
'
run 'particle p mass 1 at x + abs(t - 1)\nrun 0..3'
run 'lagrangian if(t < 1, 1, 4)*x'\''^2/2\nstart x'\'' = 1\nrun 0..3'
run 'lagrangian x'\''^2/2 + floor(t)*x'\''\nstart x'\'' = 1\nevent a: t = 1 then x'\'' = x'\'' - 1\nrun 0..1.5'
run 'particle p mass 1 at x + max(t - 1, 0)^2\nrun 0..3'
