# A state is stored in doubles, which all runs round alike: the sine of an angle near 22 is uncertain by
# the rounding of 22. Values by digits 25.
printf '%s\n' 'coord rho > 0, phi, z' 'particle p mass 1 at (rho*cos(phi), rho*sin(phi), z)' \
    'potential -1/sqrt(rho^2 + z^2)' "start rho = 1, phi' = 1e-5, z' = 1.1" 'run 0..30' \
    'value(rho*sin(phi), 30)' 'value(sin(phi), 30)' |
    qdot -q --json - | sed -n 's/.*"value":\(.*\),"error":\(.*\)}/\1 \2/p' |
    awk '{ e = $1 - (NR == 1 ? 7.90164257758888972181368e-06 : 6.77135782674371932613773e-06)
           print (e < 0 ? -e : e) <= 3 * $2 ? "within what is stated" : "wrong: " $0 }'
