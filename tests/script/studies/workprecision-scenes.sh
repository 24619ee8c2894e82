# Speed against error of scenes with constraints, events, switches, and of one at rest.
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
workprecision 0..1' | qdot --json - | sed 's/,"statement.*}/}/' |
    awk -F , '/"kind":"row"/ { rows++; if ($NF !~ /^"done"/) print "what is this:", $0 } END { print rows % 13, "left of rows by thirteen" }'
