# Saved, read and saved again a session is the same file, with its comments.
cat >from.lag <<'END'
param k = 2, m = 1
coord y, x
particle p mass m at x
particle q mass m at y
potential k*x^2/2 + y^2/3
start y = 2, x = 1/3, y' = 3
run 0..0.8 with y = 1/2 as a
start a
start x = 3.1
run 0..1 as b
A = value(x, 0.4)
start b
remove potential
potential k*x^2 + y^2
run 0..1 as c
C = value(y, 1/2)
start c
start y = 1/4
END
for names in 'from one' 'one two' 'two three'; do
    set -- $names
    qdot -q $1.lag -e "save session to \"$2.lag\"" 2>&1 | grep -c notice
done
cmp one.lag two.lag && cmp two.lag three.lag && echo same
grep '#\|^start\|^reset\|^run' one.lag | sed 's/ \([-0-9]*\/[0-9]*\)\{1,\} #/ N #/; s/error [0-9.e-]*/error E/; s/, [-0-9.]* +- .*/, N +- E/'
# a name that is there again has no comment of its loss
qdot -q two.lag -e 'A = 5; save session to "found.lag"' >/dev/null 2>&1
grep -c '^# A' found.lag two.lag
# numbers are those of the session; the error of a start from a run that is gone is in its comment alone
for name in from one three; do qdot --json $name.lag -e 'value(c.x, 1/2); value(c.y, 1/2); C' | tail -n 3 | sed 's/"statement":[0-9]*,"line":[0-9]*,*//; s/"error":[^,}]*//' >$name.out; done
cmp from.out one.out && cmp one.out three.out && grep -c . from.out
