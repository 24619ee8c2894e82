# With --processor=any all digits of a run are those of every machine of a kind: processor.inc has
# those of x86-64. Others fuse multiplications into sums where the compiler does, and round
# otherwise: there the first 12 digits are compared. No sine here: a C library's functions have last
# digits of their own.
case $(od -An -tx1 -j18 -N1 "$(command -v qdot)") in # its machine; an emulated one is a script
*3e) differs=0 ;;
*) differs=1e-12 ;;
esac
qdot -q --json --processor=any - <<'SCENE' |
coord x, y
particle p mass 1 at (x, y)
potential -1/sqrt(x^2 + y^2)
start x = 1, y' = 0.7
run 0..30
run 0..30 method dop853
run 0..30 method rk8pd
run 0..30 tol 1e-15
reset
coord x, y, z
particle a mass 1 at (x, y)
particle b mass 2 at (z, y^2)
constraint rod: x^2 + y^2 = 1
constraint (z - x)^2 + y^4 = 4
gravity (0, -1)
start x = 3/5, y = 4/5
run 0..10
SCENE
    sed -n 's/.*"method":"\([a-z0-9]*\)".*"state":\({[^}]*}\).*/\1 \2/p' |
    tr ' {,}' '\n\n\n\n' >seen
tr ' {,}' '\n\n\n\n' <processor.inc | paste -d '|' - seen |
    awk -F '|' -v differs=$differs '
    function number(s) { sub(/.*:/, "", s); return s + 0 }
    $1 != $2 {
        d = number($1) - number($2)
        if (differs == 0 || (d < 0 ? -d : d) > differs)
            print
    }
    END { print NR " compared" }'
