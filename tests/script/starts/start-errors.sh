# A run from the end of another goes on with its error: truth is the same motion in one piece. Pendulum, bouncing ball with
# drag, rod. Not so where the start was put otherwise meanwhile.
check()
{
    qdot -q - | awk -v name="$1" '/^value/ && / ± / { value[++n] = $(NF - 2); error[n] = $NF }
        END { for (i = 1; i <= n/2; i++) {
            off = value[i] - value[n/2 + i]; if (off < 0) off = -off
            print name, off <= error[i] + error[n/2 + i] ? "within its error" : "off by " off ", " error[i] " stated",
                  error[i] < 1e-2 ? "" : "which is large: " error[i] } }'
}
legs='run 0..5 tol 1e-5 method dop853 as a
start a
run 5..9 as b
value(b.x, 5)
value(b.x, 9)
start b
run 9..12 as c
value(c.x, 12)
reset start'
truth='run 0..12 as d
value(d.x, 5)
value(d.x, 9)
value(d.x, 12)'
check pendulum <<END
coord x
lagrangian x'^2/2 + cos(x)
start x = 2
$legs
start x = 2
$truth
END
check ball <<END
coord x, y
particle p mass 1 at (x, y)
gravity (0, -1)
force (-x'*(1 + y)/10, 0) on p
event floor: y = 0 falling then y' = -0.9*y'
start y = 1.5, x' = 1
$legs
start x = 0, y = 1.5, x' = 1, y' = 0
$truth
END
check rod <<END
coord x, y
particle p mass 1 at (x, y)
gravity (0, -1)
constraint rod: x^2 + y^2 = 1
start x = 0.6, y = 0.8
$legs
start x = 0.6, y = 0.8
$truth
END
# An exact start anew, an undone one, sweeps from one with an error, and digits.
qdot -q - <<'END' | sed -n 's/ ± .*e-1[5-9]$/ ± rounding/; /^value\|notice\|^b.*1e-4/p' | sed 's/\([0-9]\.[0-9]\{3\}\)[0-9]*/\1/'
coord x
param k = 1
lagrangian x'^2/2 + k*cos(x)
start x = 2
run 0..5 tol 1e-4 method dop853 as a
start a
start x = 2, x' = 0
run 0..2 as b
value(b.x, 2)
start a
undo
run 0..2 as b
value(b.x, 2)
start a
run 5..6 digits 20 as b
END
