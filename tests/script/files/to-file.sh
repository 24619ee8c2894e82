# `to FILE` ends any answer; latex(...) is a statement. Notices stay where they are.
qdot -q - <<'END'
coord x
particle a mass 2 at x
gravity -3
T to "t.txt"
eom to "eom.json"
latex(eom) to "eom.tex"
latex(x'^2/3)
print "L is", latex(lagrange_function)
check T == x'^2 to "check.json"
print "p", x to "p.txt"
k^2 to "k.txt" for k = 1..2
to = 3
to*2 to "to.txt"
check eom == (x'' = -3)
check (a = 0) == (2*a = 0) to "a.txt"
END
qdot -q --json -e 'coord x; x^2 to "x.txt"; latex(x/2); param T to "no.txt"'
qdot -q -e 'coord x; x^2 to "x.svg"'
qdot -q -e 'coord x; x^2 to "folder/x.txt"'
for file in t.txt eom.json eom.tex check.json p.txt k.txt to.txt a.txt x.txt no.txt; do
    echo "--- $file"
    cat $file 2>/dev/null
done
