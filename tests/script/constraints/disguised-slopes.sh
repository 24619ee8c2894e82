# Slopes of a wheel whose start leaves its angle unnamed, against x = x0 cos(w t), phi = (x0 - x)/r.
qdot -q -e "param m = 1, r = 1, k = 2, J = 1/2; coord x, phi; body w mass m inertia J at (x, r) angle phi; potential k*x^2/2
constraint roll: x' + r*phi' = 0; start x = 1; run 0..3; sensitivity value(x, 3) of x, k; sensitivity value(phi, 3) of x, J" |
    awk '/^d\(/ { v[n++] = $4 }
        END {
            w = sqrt(4/3); a = 3*w; s = sin(a)
            want[0] = cos(a); want[1] = -s*3*w/2/2; want[2] = 1 - cos(a); want[3] = -s*3*w/2/(3/2)
            for (i = 0; i < 4; i++) { d = v[i] - want[i]; bad += d*d > 1e-24 }
            print n, "slopes,", bad + 0, "wrong"
        }'
