# Stated errors of ends against runs with `digits`: scenes with damping, forces by t, stated
# Lagrangians, varying mass, events, switches, constraints, near collisions, unstable rests and what dies out. The
# true error is at most 3 times the stated one. Where it is above 1e-14 the stated one is at most 100
# times the true one, but for one run of a hundred. The ends are not doubles.
for name in $(sed -n 's/^### //p' end-errors.inc); do
    echo "### $name"
    {
        sed -n "/^### $name\$/,/^### /p" end-errors.inc | sed '/^###/d; /^run/d'
        limits=$(sed -n "/^### $name\$/,/^### /s/^run //p" end-errors.inc | head -n 1)
        echo "run $limits digits 20"
        for method in taylor dop853 rk8pd; do
            for tol in 1e-6 1e-9 1e-12 1e-15; do
                echo "run $limits tol $tol method $method"
            done
        done
        for tol in 1e-3 1e-6; do
            echo "run $limits tol $tol method bsimp"
        done
    } | qdot -q --json -
done >answers
awk -f end-errors.awk answers
