# Slopes by a speed's start value, and by a coordinate and a parameter while the speeds hold theirs: to 5 digits those of central
# differences of runs that start with moved values.
cat >sleigh.lag <<'END'
param m = 1, I = 0.7, a = 0.4, c = 0.2
coord x, y, phi
body sleigh mass m inertia I at (x + a*cos(phi), y + a*sin(phi)) angle phi
constraint blade: x'*sin(phi) - y'*cos(phi) = 0
torque -c*phi' on phi
speed v = x'*cos(phi) + y'*sin(phi), w = phi'
start phi = 0.3, v = 1, w = 0.5
END
{
    cat sleigh.lag
    echo 'run 0..3'
    echo 'sensitivity value(x, 3) of v, w, phi, m'
} >slopes.lag
qdot -q slopes.lag | sed -n 's|^d(value(x, 3))/\(d(.*)\) = \([^ ]*\) .*|\1 \2|p' | sort >slopes
for name in v=1 w=0.5 phi=0.3 m=1; do
    of=${name%=*} at=${name#*=}
    {
        cat sleigh.lag
        echo "run 0..3 with $of = $at + 1e-3 as up"
        echo "run 0..3 with $of = $at - 1e-3 as down"
        echo "numeric((value(up.x, 3) - value(down.x, 3))/2e-3)"
    } >moved.lag
    echo "d($of) $(qdot -q moved.lag | awk '/^numeric/ { print $(NF - 2) }')"
done | sort >differences
paste -d ' ' slopes differences | awk '{ print $1, ($2 - $4)^2 < 1e-10 * (1 + $2^2) ? "agree" : "differ: " $0 }'
