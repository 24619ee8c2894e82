# `undo` within an included script goes back to its beginning; the whole is one statement.
printf 'z = 1\nundo\nz = 2\ny = z + 1\nundo\nredo\n' >own.lag
qdot -q -e 'a = 1; include "own.lag"; vars; undo; vars; redo; vars'
printf 'z = 1\nundo 2\n' >more.lag
qdot -q -e 'a = 1; include "more.lag"'
printf 'z = 1\nreset\nw = 2\n' >forget.lag
qdot -q -e 'a = 1; include "forget.lag"; undo; vars; redo; vars'
# in several scripts, too
echo 'b = 2' >two.lag
qdot -q own.lag two.lag -e 'undo 2; vars'
