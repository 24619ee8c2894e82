# save history: what was typed and succeeded
cat >part.lag <<'END'
param c
END
qdot --json -i >/dev/null 2>&1 <<'END'
coord x
nobody
param a = 2; b = a*x^2
include "part.lag"
undo
(b +
  1)
print k for k = 1..2
save history to "typed.lag"
print "later"
save history to "typed.lag"
scene to "scene.lag"
save history to "scene.lag"
END
cat typed.lag
echo "--- again"
qdot -q typed.lag
qdot -q -e 'param a; save history to "note.txt"'
echo 'coord x' >mine.lag
qdot -q -e 'param a; save history to "mine.lag"'
