# A sweep that is killed goes on from its file, with the same bits.
cat >scene.lag <<'END'
coord th1, th2
particle a mass 1 at (sin(th1), -cos(th1))
particle b mass 1 at (sin(th1) + sin(th2), -cos(th1) - cos(th2))
gravity (0, -9.81)
event flip: cos(th2) = -1 stop
END
sweep='sweep th1 = -3..3 count 60, th2 = 0..3 count 6 run 0..30 tol 1e-9 : th2, flip[1], energy'
qdot -q --json scene.lag -e "$sweep as m" >whole 2>&1
kills=0
for wait in 0.05 0.3 0.6 $(seq 1.2 0.3 60); do
    timeout -s KILL "$wait" qdot -q --json scene.lag -e "$sweep as m threads 2 resume \"rows.h5\"" >pieces 2>&1 && break
    kills=$((kills + 1))
done
grep -v disable-threads pieces | cmp whole - && grep -c '"kind":"row"' pieces
[ $kills -gt 0 ] && echo 'it was killed on the way'
echo '# once more: all is there'
qdot -q scene.lag -e "$sweep resume \"rows.h5\"" 2>&1 | sed 's/in [0-9.e-]* s/in S/; s/[0-9]* failed/N failed/; s/, the errors of [0-9]* unknown//'
echo '# another sweep, another scene, another file'
qdot -q scene.lag -e 'sweep th1 = 0..1 count 2 run 0..1 : th2 resume "rows.h5"' 2>&1
qdot -q scene.lag -e 'gravity (0, -1)' -e "$sweep resume \"rows.h5\"" 2>&1
echo no >no.h5
qdot -q scene.lag -e 'sweep th1 = 0..1 count 2 run 0..1 : th2 resume "no.h5"' 2>&1
head -c 3000 rows.h5 >short.h5
qdot -q scene.lag -e "$sweep resume \"short.h5\"" 2>&1
qdot -q scene.lag -e 'sweep th1 = 0..1 count 2 run 0..1 : th2 resume "rows.csv"' 2>&1
qdot -q scene.lag -e 'sweep th1 = 0..1 count 2 run 0..1 : th2 resume "/nowhere/rows.h5"' 2>&1 | head -1
echo '# a byte that is not the one written'
python3 -c '
data = bytearray(open("rows.h5", "rb").read())
data[len(data) // 2] ^= 1
open("odd.h5", "wb").write(data)' 2>/dev/null || { dd if=rows.h5 of=odd.h5 2>/dev/null; printf 'x' | dd of=odd.h5 bs=1 seek=$(($(wc -c <rows.h5) / 2)) conv=notrunc 2>/dev/null; }
qdot -q scene.lag -e "$sweep resume \"odd.h5\"" 2>&1
echo '# two at a time'
long='sweep th1 = -3..3 count 4000 run 0..30 tol 1e-12 : th2'
qdot -q scene.lag -e "$long threads 1 resume \"two.h5\"" >/dev/null 2>&1 &
until [ -f two.h5 ]; do sleep 0.05; done
qdot -q scene.lag -e "$long resume \"two.h5\"" 2>&1
ln -s two.h5 link.h5
qdot -q scene.lag -e "$long resume \"link.h5\"" 2>&1 | head -1
kill -KILL $!
wait $! 2>/dev/null
ls two.h5* link.h5*
