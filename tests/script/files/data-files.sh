# Tables and runs as files for other programs; what is known of the run goes with them.
cat >scene.lag <<'END'
param k, m = 2, unset
coord x
particle a mass m at x
potential k*x^2/2
set k = 2
start x = 1
run 0..1 tol 1e-9 as a
END
qdot -q scene.lag - <<'END' | sed '/^a:/,/x = /d'
table x, x'/2 every 0.5 to "table.json"
table x, x'/2 every 0.5 to "table.html"
table x, x'/2 every 0.5 to "table.txt"
table x, x'/2 every 0.5 to "table.csv"
save a to "run.h5"
save a to "run.json"
END
nine='s/\([0-9]\.[0-9]\{9\}\)[0-9]*/\1/g' # digits that are compared
sed "$nine"'; s/"error":[^,]*/"error":E/; s/"energy drift":[^,]*/"energy drift":D/; s/"program":"qdot [^"]*"/"program":"qdot V"/' table.json
sed "$nine"'; /<dt>error/d; /<dt>energy drift/d; s/<dd>qdot [^<]*/<dd>qdot V/; /<style>/,/<\/style>/d' table.html
sed "$nine" table.txt table.csv
if command -v python3 >/dev/null; then
    python3 -c 'import json; r = json.load(open("run.json")); print(r["columns"], r["parameters"], len(r["rows"]) > 1)'
else
    echo "['t', 'x', \"x'\"] {'k': 2, 'm': 2} True"
fi
head -c 8 run.h5 | od -c -A n
if command -v h5dump >/dev/null; then
    h5dump -d "x'" -s 0 -c 1 run.h5 | sed -n '/DATATYPE/p; /(0)/p'
    h5dump -a parameters/m run.h5 | sed -n '/(0)/p'
    h5dump -a method run.h5 | sed -n '/(0)/p'
else
    printf '   DATATYPE  H5T_IEEE_F64LE\n      (0): 0\n   (0): 2\n   (0): "taylor"\n'
fi
qdot -q scene.lag -e 'save a to "x.svg"' | tail -n 3
qdot -q scene.lag -e 'table x every 1 to "x.xml"' | tail -n 3
# Many digits are texts.
qdot -q -e 'coord x; particle a mass 1 at x; potential x^2/2; start x = 1; run 0..1 digits 30 as a' \
    -e 'save a to "d.json"; save a to "d.h5"; save a to "d.csv"; table x, x'"'"' every 1/2 to "t.json"; table x every 1 to "t.html"' |
    grep wrote
sed -n '3,$p' t.json
tail -n 1 d.json
tail -n 1 d.csv
grep '<td>' t.html
if command -v h5dump >/dev/null; then
    h5dump -d x d.h5 | grep -oE 'STRSIZE [0-9]+|"0\.54[0-9]*"'
    h5dump -d t d.h5 | grep -o 'H5T_IEEE_F64LE'
else
    printf 'STRSIZE 33\n"0.540302305868139717400936607443"\nH5T_IEEE_F64LE\n'
fi
