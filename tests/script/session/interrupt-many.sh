# Ctrl-C while the accelerations of 3000 coordinates are sought ends that: no entry of the matrix begins it anew.
awk 'BEGIN {
    printf "coord x0"
    for (i = 1; i < 3000; i++) printf ", x%d", i
    for (i = 0; i < 3000; i++) printf "\nparticle p%d mass 1 at x%d", i, i
    print "\naccel"
}' >many.lag
timeout -s INT -k 100 2 qdot -q many.lag >/dev/null 2>&1
[ $? -eq 137 ] && echo 'it went on' || echo 'it ended'
