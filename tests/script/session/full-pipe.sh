# Ctrl-C while the pipe that is written to is full: what was begun is written, whole, and the interruption is told.
mkfifo out
# Interrupt a script when it has written as much as the pipe takes; then read the rest.
interrupt()
{
    qdot -q script.lag >out 2>err &
    pid=$!
    exec 3<out
    read -r first <&3
    sleep 0.7 # until the pipe is full
    kill -INT $pid
    sleep 0.2
    { echo "$first"; cat <&3; } >read
    exec 3<&-
    wait $pid
    echo "exit $?"
    sed 's/^script.lag:[0-9:]* //' err | grep 'error'
}
echo '# many answers'
echo 'print k for k = 1..10^6' >script.lag
interrupt
awk '$0 != NR { print "line", NR, "is", $0; exit }' read
echo '# one answer that the pipe does not take at once'
{ echo 'print "first"'; echo 'print "'"$(head -c 200000 /dev/zero | tr '\0' x)"'"'; echo 'print 2'; } >script.lag
interrupt
wc -c <read | tr -d ' '
