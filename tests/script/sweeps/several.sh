# Scripts and texts share one session; a refuted check lets all of them go on, an error none.
echo 'print "from standard input", x' >in.txt
echo 'x = 4' >one.lag
qdot -q one.lag -e 'print x' - <in.txt
echo "exit $?"
qdot -q -e 'check 1 == 2' -e 'print "still here"'
echo "exit $?"
qdot -q -e 'nothing' -e 'print "never"' 2>/dev/null
echo "exit $?"
qdot -q -e '(' -e 'print "never"' 2>/dev/null
echo "exit $?"
qdot -q -e 'print 1' -i <in.txt 2>&1
echo "exit $?"
qdot --no-such-option 2>/dev/null
echo "exit $?"
