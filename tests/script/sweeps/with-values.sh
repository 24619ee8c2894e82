# Values behind `with` hold for all of a run: its limits, the columns of a sweep, by lanes and alone.
qdot -q - <<'END' 2>&1 | sed -n 's/, total .*//p; s/, in .*//p; /proved\|rror:/p'
param k, m, tau = 2
coord x
lagrangian m*x'^2/2 - k*x^2/2
start x = 1
event e: x = 0
set k = 1, m = 1
run 0..tau with tau = 3 as a
check value(a.x, 3) == cos(3) within 1e-11
sweep k = 1..3 count 3 run 0..3 with m = k : e[1], m as c
sweep k = 1..3 count 17 run 0..3 with m = k : e[1], m as d
sweep k = 2..3 count 2 run 0..tau with m = k, tau = 1 : acos(x), m as f
save c to "c.csv"; save d to "d.csv"; save f to "f.csv"
END
for table in c d f; do # k, a quarter of the period or the end, m, errors
    awk -F, -v right=$([ $table = f ] && echo 1 || echo 1.5707963267948966) 'FNR > 1 {
            rows++
            if ($1 != $3 || ($2 - right)^2 > 1e-20)
                print "wrong: " $0
        }
        END { print rows " rows" }' $table.csv
done
# What the runs tell of their starts is told.
qdot -q - <<'END' 2>&1 | sed -n '/^notice/p'
coord x, y
particle p mass 1 at (x, y)
constraint c: x^2 + y^2 = 1
start x = 0.6, y = -0.8
sweep x = 0.3..0.5 count 3 run 0..0 : y
sweep x' = 0..0.1 count 3 run 0..0 : y
END
