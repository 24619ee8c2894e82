# Options of figures that cannot be: each says what is wrong and where.
for text in 'range 3..1' 'from 2 to 2' 'from 0 5' 'log z' 'size 1, 5' 'size 8' 'title x' \
    'labels "a", "b", "c"' 'keep keep' 'to "a.svg" to "b.svg"' 'rnage 0..1' '| x' 'vs y' 'from 0 to 1 log x' \
    'range -1..1 log y'; do
    qdot -q -e "coord x; plot x^2 vs x = 0..1 $text"
    echo "exit $?"
done
for text in 'x vs y, y' 'p, x' 'p vs x' 'p log x' 'p range 0..1' 'drift(p)' 'x from 5 to 6' 'p, q' 'v' 'q labels "a", "b", "c"'; do
    qdot -q -e "coord x, y, z; particle p mass 1 at (x, y, z); q = (x, y)
v = (x, y, z, x)
start x = 1; run 0..1 to \"run.txt\"; plot $text" >run.out 2>&1
    echo "exit $?" >>run.out
    sed '/^wrote run.txt/d' run.out
done
ls *.svg 2>/dev/null
