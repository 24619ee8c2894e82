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
# What cannot be said is refused before anything is integrated.
echo 'coord x; particle a mass 1 at x; workprecision 0..1 to "wp.doc"' | qdot -
echo 'coord x; particle a mass 1 at x; workprecision 0..0' | qdot -
echo 'coord x; particle a mass 1 at x; workprecision 0..1 tol 1e-9' | qdot -
