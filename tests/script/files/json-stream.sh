# each object says which statement made it; on a pipe each statement is answered, and told when it is done
cat >inner.lag <<'END'
print 1
print 2
END
qdot --json - <<'END'
coord x; print "a"

include "inner.lag"
print k for k = 1..2
{
    print 3
} for k = 1..1
check x^2 == 4 when x = 2
END
echo "--- a pipe"
qdot --json -i 2>/dev/null <<'END'
coord theta
# nothing
param l > 0, g > 0

lagrangian l*theta'^2/2 + g*cos(theta); check T == l
nobody
print (1 +
  2)
run 0..(
x = )
set l = 1, g = 9.8; start theta = 0.1; run 0..1
table theta, theta' every 1
sweep l = 1..2 step 1 run 0..1 : value(theta, 0) as res
"no end
quit
print 4
END
echo "exit $?"
echo "--- while it is open"
mkfifo to from
qdot --json -i <to >from &
exec 3>to 4<from
echo 'print 1' >&3
read -r one <&4; read -r two <&4
echo "$one"; echo "$two"
exec 3>&-
wait
echo "--- Ctrl-C while it waits, within a statement, within a line, during one"
qdot --json -i <to >from 2>err &
pid=$!
exec 3>to 4<from
answers() { while read -r line <&4; do echo "$line"; case $line in *'"done"'*) break ;; esac; done; }
# what a statement that was stopped answers in the end; where in its loop that is, is a matter of chance
stopped() { answers | sed 's/"column":[0-9]*/"column":0/'; }
press() { sleep 0.3; kill -INT $pid; kill -INT $pid; sleep 0.1; } # with time to begin to wait
echo 'print 1' >&3
answers
press
echo 'print 2' >&3
answers
echo '(1 +' >&3
press
echo 'print 3' >&3
answers
printf 'print (4' >&3
press
echo ' + 1)' >&3
answers
echo 'print 5.5; x = k for k = 1..9*10^6' >&3
answers # then the second one is under way
kill -INT $pid
stopped
echo 'print 6' >&3
answers
echo 'print 7; 1/0; print "left out"' >&3 # an error ends its line
answers
answers
echo 'print 7.5; x = k for k = 1..9*10^6' >&3
answers
for k in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do kill -INT $pid; done
stopped
sleep 0.3
echo 'print 8' >&3
answers
exec 3>&-
wait $pid
echo "exit $?"
sed -e '/^stopping soon/d' -e '/^ *^$/d' -e 's/:[0-9]*: error: interrupted/: error: interrupted/' err # to a second one, if the statement is still under way
