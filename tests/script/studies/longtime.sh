# The error of the energy over a long time: the table, the growths, files by ending, rows as JSON.
cat >lt.lag <<'END'
coord x
particle a mass 1 at x
potential -cos(x)
start x = 2
longtime 0..2000 tol 1e-6
longtime 0..2000 tol 1e-6 method gauss6 to "lt.csv"
longtime 0..2000 tol 1e-6 method gauss6 to "lt.txt"
longtime 0..-2000 method verlet tol 1e-4 to "lt.svg"
END
# a method, and whether its error grows
cat >growth.awk <<'END'
/^[a-z0-9]+ +1e-/ { split($7, g, "^"); print $1, (g[2] < 0.2 ? "stays" : g[2] > 0.6 ? "grows" : g[2]), $NF }
/^wrote/ { print }
END
qdot -q lt.lag | awk -f growth.awk
head -n 1 lt.csv
awk -F , 'NR > 1 && ($1 != "gauss6" || $2 != 1e-6 || NF != 4 || $4 <= 0) { print "what is this:", $0 }
    END { print (NR > 10), $3 }' lt.csv
head -n 1 lt.txt
grep -c '<svg' lt.svg
echo 'coord x; particle a mass 1 at x; potential x^4; start x = 1; longtime 0..1000 tol 1e-6 method gauss4' | qdot --json - |
    awk '/"kind":"row","values":\["gauss4",1e-06/ || /"kind":"row","values":\["gauss4",9.9/ { rows++ } /"kind":"number","name":"growth\[gauss4\]"/ { n++ }
        END { print (rows > 10), n }'
# What does not fit is left out, or refused where it was asked for.
scene='coord r > 0, phi; particle a mass 1 at (r*cos(phi), r*sin(phi)); potential r^2; start r = 1, phi'"'"' = 1'
echo "$scene; longtime 0..1000 tol 1e-6" | qdot - 2>&1 | grep -c '^notice.*verlet needs constant masses'
echo "$scene
longtime 0..1000 method verlet" | qdot -
echo 'coord x; particle a mass 1 at x; potential x^2; dissipation x'"'"'^2
longtime 0..1000' | qdot -
echo 'coord x; particle a mass 1 at x; potential x^2; event e: x = 0 stop
longtime 0..1000' | qdot -
echo 'coord x; particle a mass 1 at x; longtime 0..0' | qdot -
echo 'coord x; particle a mass 1 at x; longtime 0..10 method euler' | qdot -
echo 'coord x; particle a mass 1 at x; longtime 0..10 tol 2' | qdot -
echo 'coord x; particle a mass 1 at x; longtime 0..10 to "x.doc"' | qdot -
