# Branches of orbits as JSON, files, figures.
cat >duffing.lag <<'END'
param Omega, F
coord x
particle b mass 1 at x
potential x^2/2 + x^4/4
force -0.1*x' + F*cos(Omega*t) on b
set Omega = 0.5, F = 0.5
find x = 0.6, x' = 0 such that returns after 2*pi/Omega
END
qdot -q --json duffing.lag -e 'continue orbit in Omega = 0.5..3' >out.json
# the period is the drive's; what is unstable has a multiplier beyond the circle, what is stable none
awk -F'[][,:}]*' '/"row","name":"branch/ {
        match($0, /"values":\[[^]]*/); split(substr($0, RSTART + 10, RLENGTH - 10), v, ",")
        off = v[1]*v[3] - 6.283185307179586; if (off < 0) off = -off
        if (off > 1e-12) print "another period: " $0
        n++; folds += v[6] > 0.9999999 && v[6] < 1.0000001
        if ($0 !~ "\"stable\":" (v[6] > 1 ? "false" : "true") && v[6] - 1 > 1e-7) print "not so: " $0 }
    END { print (n > 100 ? "many points" : n " points"), folds, "folds" }' out.json
short='{ while (match($0, /-?[0-9]+\.[0-9]+(e-?[0-9]+)?/)) { printf("%s%.9g", substr($0, 1, RSTART - 1), substr($0, RSTART, RLENGTH))
        $0 = substr($0, RSTART + RLENGTH) } print }'
grep bifurcation out.json | awk "$short"
qdot -q duffing.lag - <<'END' | tail -n 5
continue orbit in Omega = 0.5..3 as response
save response to "response.csv"
save response_bifurcations to "points.csv"
plot response to "response.svg" keep
END
head -n 1 response.csv; cut -d, -f1-7 points.csv | awk "$short"
grep -o "dashtype [^ ]*\|with points\|title \"[^\"]*\"" response.gp
# a cycle that shrinks to the place at rest at mu = 0, from T = 2*pi on
ends() { qdot -q "$@" 2>&1 | awk '/^branch\[1\] [a-z]/ { gsub(/,/, ""); print $1, $2, $3, $4, $5, $6
        for (i = 3; i <= NF; i++) if ($(i - 1) == "=") printf("%s %.6f\n", $(i - 2), $i) }'; }
ends - <<'END' | head -n 3
param mu
coord x
particle b mass 1 at x
potential x^2/2
force (mu - x^2)*x' on b
set mu = 1
find x = 2, T = 6.6 such that returns after T
continue orbit in mu = -1..1
END
# one that ends at a saddle, where its period is infinite; and begins at mu = 1
ends - <<'END' | grep -v '^T\|max'
param mu
coord x
particle b mass 1 at x
potential -x^2/2 + x^3/3
force -0.3*(mu - x)*x' on b
set mu = 0.93
find x = 0.4, T = 7.3 such that returns after T
continue orbit in mu = 0.5..1.2
END

# why a branch ends: motions near by grow to e^22 in a period; a force has no value beyond x = 2
qdot -q - <<'END' 2>&1 | grep -o 'notice.*\|ends where.*left\|is lost: .*undefined'
coord theta
param w
lagrangian theta'^2/2 - 9.8*cos(theta) + 0.1*cos(w*t)*theta
set w = 3
find theta = 0, theta' = 0 such that returns after 2*pi/w as top
continue orbit in w = 0.4..4
END
qdot -q - <<'END' 2>&1 | grep -o 'is lost: .*undefined'
coord x
lagrangian x'^2/2 - x^2/2 - (2 - x)^(5/2)/50
start x = 0.5
find T = 6 such that returns after T
continue orbit in x = 0.5..3
END

# a period doubling at the end of the range: no orbits of twice the period within it
qdot -q - <<'END' 2>&1 | grep 'twice the period'
param F
coord x
particle b mass 1 at x
potential x^4/4 - x^2/2
force -x'/4 + F*cos(t) on b
set F = 2.5
find x = 1.2, x' = 2.4 such that returns after 2*pi
continue orbit in F = 2.3..2.6543258
END

# driven by a limit cycle: orbits of four turns, too, end where they become one of two, as one branch
qdot -q - <<'END' 2>&1 | sed -n 's/^period doubling  \(1\.[0-9]\{9\}\).* \(branch.*\)/\1 \2/p'
coord u, x
param F
particle a mass 1 at (u, 0)
particle b mass 1 at (x, 1)
potential x^4/4 - x^2/2 + u^2/2
force ((1 - u^2)*u'/4, 0) on a
force (-x'/4 + F*u, 0) on b
set F = 1.35
start u = 2
find u = 2, x = 1.2, x' = 2.3, T = 6.3 such that returns after T
continue orbit in F = 1.34..1.735
END
