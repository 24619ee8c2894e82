# The error of values at times within a run, where differences pass through zero: against
# runs with `digits` of the reference cases, at tolerances from loose to what a double can hold.
scene()
{
    sed -n "/^### $1\$/,/^### /p" cases.inc | sed '/^###/d'
}
# Coordinates of the case, at most three.
coordinates()
{
    sed -n "/\"case\":\"$1\"/s/.*\"values\":{\([^}]*\)}.*/\1/p" cases.json | tr ',' '\n' |
        sed -n 's/^"\([a-z0-9]*\)":.*/\1/p' | head -n 3
}
for name in double-pendulum-5 duffing foucault henon-heiles rotating-hoop swinging-atwood \
    elastic-pendulum heavy-top spring-damper pendulum-cartesian knife-edge; do
    end=$(sed -n "s/.*\"case\":\"$name\",\"t_end\":\"\([^\"]*\)\".*/\1/p" cases.json)
    echo "### $name"
    {
        scene "$name"
        echo "run 0..$end digits 18 as exact"
        for tol in 4 8 12 15; do
            echo "run 0..$end tol 1e-$tol as r$tol"
        done
        for share in 0.0137 0.283 0.3917 0.5 0.6121 0.777 0.91 0.9973; do
            for q in $(coordinates $name); do
                for e in "$q" "$q'" "$q''" "($q*$q')"; do
                    echo "value(exact.$e, $share*$end)"
                    for tol in 4 8 12 15; do
                        echo "value(r$tol.$e, $share*$end)"
                    done
                done
            done
        done
    } | qdot -q --json -
done >answers
awk -f inner-times.awk answers
echo '# behind a jump, which a companion does a little earlier: not the height of that jump'
{
    cat <<'END'
coord x
particle p mass 1 at x
potential x^2/2
force 1000*(1 - x^2)*x' on x
start x = 2
run 0..2000 tol 1e-10 as exact
run 0..2000 tol 1e-4 method msbdf as r4
run 0..2000 tol 1e-5 method msbdf as r5
END
    for t in 1650 1700 1750 1900 2000; do
        printf 'value(%s.x, '"$t"')\n' exact r4 r5
    done
} | qdot -q --json - | awk -F'[:,]' '
    /"name":"value/ { name = $4; value = $7; error = $9 + 0 }
    /"name":"value\(exact/ { want = value; next }
    /"name":"value/ { d = value > want ? value - want : want - value; n++
        if (d > 3*error || error > 0.1) print }
    END { print n, "values" }'
