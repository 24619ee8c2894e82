# A sweep by several processes: the same bits, and what is left when some die or Ctrl-C is pressed.
cat >scene.lag <<'END'
coord th1, th2
particle a mass 1 at (sin(th1), -cos(th1))
particle b mass 1 at (sin(th1) + sin(th2), -cos(th1) - cos(th2))
gravity (0, -9.81)
event flip: cos(th2) = -1 stop
END
good='sweep th1 = -3..3 count 8, th2 = 0..3 count 5 run 0..20 tol 1e-9 : th2, max(abs(th1)), flip[1] as m'
for n in 1 2 5; do
    qdot -q --json scene.lag -e "$good threads $n" 2>&1 | grep -v 'disable-threads' >"of-$n"
done
cmp of-1 of-2 && cmp of-1 of-5 && grep -c '"kind":"row"' of-1
grep -q '"failed"' of-5 && echo 'some failed'
echo '# workers are killed again and again'
more='sweep th1 = -3..3 count 60, th2 = 0..3 count 10 run 0..20 tol 1e-9 : th2, max(abs(th1)), flip[1] as m'
qdot -q --json scene.lag -e "$more threads 1" >of-one 2>&1
qdot -q --json scene.lag -e "$more threads 3" >of-killed 2>&1 &
pid=$!
while kill -0 $pid 2>/dev/null && [ "${kills:-0}" -lt 4 ]; do
    victim=$(cut -d ' ' -f 1 /proc/$pid/task/$pid/children 2>/dev/null)
    [ -n "$victim" ] && kill -9 $victim 2>/dev/null && kills=$((${kills:-0} + 1))
    sleep 0.02
done
wait $pid
grep -v -e 'process that made the run has ended' -e 'disable-threads' of-killed | sort >a
sort of-one | grep -F -x -f a | wc -l | tr -d ' ' >b
[ "$(wc -l <a | tr -d ' ')" -ge 592 ] && [ "$(cat b)" = "$(wc -l <a | tr -d ' ')" ] && echo 'the rows are the same'
if [ -e /proc/$$/task/$$/children ] && [ "${kills:-0}" = 0 ]; then
    qdot --version | grep -q 'disable-threads' || echo 'none was there to kill' # such a build has no workers
fi
echo '# Ctrl-C keeps what is done'
sed -i.old 's/ stop$//' scene.lag
cat >long.lag <<'END'
sweep th1 = -3..3 count 4000 run 0..20 tol 1e-9 : th2 as m threads 2
END
for wait in 1.5 5 15 45; do # until rows have come
    timeout --foreground --preserve-status -k 20 -s INT $wait qdot -q scene.lag long.lag >long 2>&1
    grep -q "interrupted: m has" long && break
done
grep -c 'interrupted: m has [0-9]* of 4000 rows' long
echo '# a program that begins no processes says so'
qdot scene.lag -e "$good threads 2" 2>&1 | grep -c 'disable-threads' >said
qdot scene.lag -e "$good threads 1" 2>&1 | grep -c 'disable-threads' >>said
qdot --version | grep -q 'disable-threads' && wanted=1 || wanted=0
[ "$(tr '\n' ' ' <said)" = "$wanted 0 " ] || cat said
