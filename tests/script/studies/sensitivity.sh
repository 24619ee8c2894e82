# Slopes of numbers of a run by parameters and initial values, against differences and closed forms.
same='s/ ± .*//' # what is compared
cat >double.lag <<'END'
param m1, m2, L1, L2, g > 0
coord theta1, theta2
r1 = (L1*sin(theta1), -L1*cos(theta1))
particle a mass m1 at r1
particle b mass m2 at r1 + (L2*sin(theta2), -L2*cos(theta2))
gravity (0, -g)
set m1 = 1, m2 = 2*m1, L1 = 1, L2 = 1, g = 9.81
start theta1 = L1, theta2 = 1
END
# what a value is made of follows it: m2 = 2*m1, theta1 = L1; without a run one is made up to the time named
qdot -q double.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same"
sensitivity value(theta1 + theta2', 3) of m1, L1, g, theta2, theta1'
END
qdot -q double.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v '^  '
run 0..3 digits 25 as p with L1 = 1.00001
run 0..3 digits 25 as n with L1 = 0.99999
print (value(p.(theta1 + theta2'), 3) - value(n.(theta1 + theta2'), 3))/0.00002
run 0..3 digits 20 as exact
sensitivity value(theta1 + theta2', 3) of L1
# within a run that had other values
run 0..3 with m2 = 2, g = 9.81, theta1 = 1
sensitivity value(theta1 + theta2', 3) of m1
END
# events: times, values there, what they change
cat >ball.lag <<'END'
param g = 10, e = 0.5
coord x, y
particle b mass 1 at (x, y)
gravity (0, -g)
event bounce: y = x/10 falling then y' = -e*y'
start y = 1, x' = 0.3
END
qdot -q ball.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v '^  '
run 0..1
sensitivity value(y, 1) of e, g, x, y'
sensitivity bounce[2] of e, g
sensitivity value(y', bounce[1] + 0.1) - e*g*bounce[1] of e
sensitivity mean(y, 0..1) of g
# a largest or least value: within the range, at its end
sensitivity max(y, 0.5..1) of e, g
sensitivity max(y) - min(y^2*g, 0..0.2) of g, y
run 0..1 as p with g = 10.0001
run 0..1 as n with g = 9.9999
print (value(p.y, 1) - value(n.y, 1))/0.0002, (p.bounce[2] - n.bounce[2])/0.0002
print (mean(p.y, 0..1) - mean(n.y, 0..1))/0.0002, (max(p.y, 0.5..1) - max(n.y, 0.5..1))/0.0002
END
# ends of a range that move: by a parameter, with an event, with the run
qdot -q - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep '^d(\|error:\|^T = '
param S = 2
coord x
lagrangian x'^2/2 - x^2/2
event low: x = -0.2 falling
start x = 1
run 0..5
sensitivity mean(x, 0..S) of S
sensitivity mean(x, S/2..S) of S, x
sensitivity min(x, 0..S) of S, x
sensitivity max(x', S..5) of S
sensitivity mean(x, 0..low[1]) of x
find T = 2.5 such that mean(x, 0..T) = 0.1
find T = 2.5 such that min(x, 0..T) = -0.9
run 0..S
sensitivity mean(x) of S
remove low
event low: x = -0.2 falling stop
run 0..5
sensitivity mean(x) of x
END
# a ball that comes to rest: before that there are slopes; a stiff scene: by radau, as the run
sed 's/y = x\/10/y = 0/' ball.lag >level.lag
qdot -q level.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep '^d(\|error:'
run 0..9
sensitivity value(y, 1) + bounce[4] of e
sensitivity value(y, 9) of e
END
qdot -q -e 'coord x; param c = 1e6; particle p mass 1 at x; potential x^2/2; force -c*x'"'"' on p; start x = 1' \
    -e 'run 0..10; sensitivity 1e12*value(x, 10) of c' 2>&1 | awk -f six.awk | sed "$same" | grep '^d('
# constraints: what the start leaves open follows
cat >rod.lag <<'END'
param m, L, g > 0, k = 0.3
coord x, y < 0
particle bob mass m at (x, y)
constraint rod: x^2 + y^2 = L^2
gravity (0, -g)
dissipation k*(x'^2 + y'^2)/2
set m = 1, L = 1, g = 9.81
start x = 0.8, x' = 0.1
END
qdot -q rod.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v '^  '
run 0..2
sensitivity value(y, 2) of m, L, k, x, x'
run 0..2 as p with L = 1.0001
run 0..2 as n with L = 0.9999
print (value(p.y, 2) - value(n.y, 2))/0.0002
END
qdot -q --json -e 'coord x; particle p mass 1 at x; potential x^2; start x = 1; sensitivity value(x, 1) of x' \
    | sed 's/\(0\.[0-9]\{6\}\)[0-9]*/\1/; s/"error":[0-9.e-]*/"error":E/'
