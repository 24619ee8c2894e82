# A file that is there stays until another is whole, and `keep` writes over none but its own.
scene='coord x
particle p mass 1 at x
potential x^2/2
start x = 1
run 0..4
'
printf '%s' "$scene" >scene.lag
qdot -q scene.lag -e 'save session to "good.lag"' >/dev/null
cp good.lag before.lag
(
    ulimit -f 0
    qdot -q scene.lag -e 'start x = 2' -e 'save session to "good.lag"' 2>&1
) | grep error:
cmp good.lag before.lag && echo 'it is as it was'
ls -A | grep '[.]part$'
echo '# data of the user'
echo '1 2' >fig.dat
qdot -q scene.lag -e 'plot x keep to "fig.svg"' 2>&1 | sed '1,/^ *x = /d'
cat fig.dat
ls fig.*
rm fig.dat
qdot -q scene.lag -e 'plot x keep to "fig.svg"' >/dev/null && qdot -q scene.lag -e 'plot x^2 keep to "fig.svg"' >/dev/null && ls fig.*
echo '# a name is no program'
qdot -q scene.lag -e 'plot x keep to "|touch ran #.svg"' >/dev/null
ls -A | grep touch
gnuplot '|touch ran #.gp' 2>/dev/null
[ -e ran ] && echo 'a program ran'
true
