# Speed against error: the columns, every method over thirteen tolerances, files by ending.
cat >wp.lag <<'END'
coord x, y
particle a mass 1 at (x, y)
potential (x^2 + y^2)/2 + x^2*y - y^3/3
start x = 1/10, y' = 1/5
workprecision 0..10
workprecision 0..10 to "wp.csv"
workprecision 0..2*pi to "wp.txt"
workprecision 0..-3 to "wp.svg"
END
qdot -q wp.lag | awk '/^[a-z0-9]+ +1e-/ { seen[$1]++ }
    /^wrote/ { print; next }
    /^err:/ { sub(/is [0-9].*/, "is N"); print }
    END { for (m in seen) print m, seen[m] | "sort" }'
head -n 1 wp.csv
awk -F , 'NR > 1 && $1 != "verlet" && ($12 != "done" || NF != 12 || $3 > 10000*$2 + 1e-13 || $5 > $6 || $11 > 1e-20) {
    print "what is this:", $0 }
    NR > 1 { rows++ }
    END { print rows % 13, "left of rows by thirteen" }' wp.csv
grep -c '^[a-z]* *1e-' wp.txt | awk '{ print $1 % 13, "left of rows by thirteen" }'
grep -c '<svg' wp.svg wp-1.svg
echo 'coord x; particle a mass 1 at x; start x'"'"' = 1; workprecision 0..1 keep size 10, 8 to "kept.svg"' | qdot -q - >kept.txt
sed -n "/^set title/s/reference .*'\./reference N'./p; /^set [xy]label/p; s/ size \([^ ]*\) .*/ \1/p" kept.gp
tr ',' '\n' <kept.gp | grep -c 'with linespoints'
awk '/^[a-z0-9]+ +1e-/ { n++ } END { print n % 13, "left of the table by thirteen" }' kept.txt
echo 'coord x; particle a mass 1 at x; workprecision 0..1' | qdot --json - |
    awk '/"kind":"row"/ { rows++ } /"kind":"row","values":\["taylor",0.001/ { print "a row of taylor" }
    END { print rows % 13, "left of rows by thirteen" }'
# With constraints: how far they were left is a column more; the reference is a run in doubles.
cat >tied.lag <<'END'
coord x, y
particle a mass 1 at (x, y)
constraint rod: x^2 + y^2 = 1
gravity (0, -9.81)
start x = 3/5, y = -4/5
workprecision 0..2 to "tied.csv"
END
qdot -q tied.lag | sed '/^notice/d'
head -n 1 tied.csv
awk -F , 'NR > 1 && $1 !~ /bsimp|msbdf/ && ($13 != "done" || $3 > 1e5*$2 + 20*$12 || $11 == "" || $11 > 10*$2 + 1e-13 || $12 > 1e-12) {
    print "what is this:", $0 }
    NR > 1 { rows++ }
    END { print rows % 13, "left of rows by thirteen" }' tied.csv
# Events that change the state, switches, and an event that ends the runs, whose time counts.
for scene in "coord x; particle a mass 1 at x; force -9.81 on x; event hit: x = 0 falling then x' = -0.8*x'
start x = 1; workprecision 0..0.6" "coord x; particle a mass 1 at x; potential x^2/2 + abs(x)/3
start x = 1; workprecision 0..1.5" "coord r > 0, phi; particle a mass 1 at (r*cos(phi), r*sin(phi)); potential -1/r
event full: phi = 1 rising stop; start r = 0.5, phi' = 3; workprecision 0..50"; do
    echo "$scene to \"divided.csv\"" | qdot -q - | sed '/^err/d; /^notice/d'
    awk -F , 'NR > 1 && $1 !~ /ms|bsimp|verlet/ && ($12 != "done" || $3 > 1000*$2 + 1e-13) { print "what is this:", $0 }
        NR > 1 { rows++; done += $12 == "done" } END { print rows, done }' divided.csv
done
# A scene at rest; the start is solved for, on another side of max than where it began.
echo 'coord x, y; particle a mass 1 at (x, y); constraint c: max(x, y) = 3; start x = 1
workprecision 0..1' | qdot --json - |
    awk -F , '/"kind":"row"/ { rows++; if ($NF !~ /^"done"/) print "what is this:", $0 } END { print rows % 13, "left of rows by thirteen" }'
# What cannot be said is refused before anything is integrated.
echo 'coord x; particle a mass 1 at x; workprecision 0..1 to "wp.h5"' | qdot -
echo 'coord x; particle a mass 1 at x; workprecision 0..0' | qdot -
echo 'coord x; particle a mass 1 at x; workprecision 0..1 tol 1e-9' | qdot -
