# Columns of a file by its names, in any order; another unit of time; gaps. A pendulum's data from a run, k = 2.
cat >make.lag <<'END'
param k = 2
coord x
particle a mass 1 at x
potential k*x^2/2
start x = 1
run 0..3
table x every 0.25 to "whole.csv"
END
qdot -q make.lag >make.txt 2>&1
fit()
{
    qdot -q -e 'param k; coord x; particle a mass 1 at x; potential k*x^2/2; set k = 1.8; start x = 1' -e "$1" -e 'check k == 2 within 1e-6' |
        sed 's/^k = \(2\|.* ± [0-9.]*e-1[0-9]\)$/k = 2 nearly/; s/^\(residuals: \)[0-9.]*e-1[0-9] /\10 /'
}
awk -F, 'NR > 1 { print $1 "," $2 }' whole.csv >plain.csv
head -3 plain.csv
fit 'fit k to "plain.csv" : t, x'
# by name: the file says x, then t; its other column does not matter
awk -F, 'BEGIN { print "x,other,t" } { print $2 ",7," $1 }' plain.csv >named.csv
fit 'fit k to "named.csv" : t, x'
fit 'fit k to "named.csv" : x, t'
# without names the order of the statement is that of the file
awk -F, '{ print $2 "," $1 }' plain.csv >turned.csv
fit 'fit k to "turned.csv" : x, t'
# milliseconds since 1 s, thousandths of a length
awk -F, '{ print 1000*$1 + 1000 "," 1000*$2 }' plain.csv >units.csv
fit 'fit k to "units.csv" : t*1e-3 - 1, 1000*x'
# gaps
awk -F, 'NR == 2 { print $1 ","; next } NR == 4 { print "NaN," $2; next } { print }' plain.csv >gaps.csv
fit 'fit k to "gaps.csv" : t, x'
# decimal commas between semicolons or tabs, quotes, a header with units, exponents of Fortran
awk -F, 'NR == 1 { print "t [s];x [m]"; next } { gsub(/\./, ",", $1); gsub(/\./, ",", $2); print $1 ";" $2 }' whole.csv >commas.csv
head -3 commas.csv
fit 'fit k to "commas.csv" : t, x'
tr ';' '\t' <commas.csv >tabs.csv
fit 'fit k to "tabs.csv" : t, x'
awk -F';' 'NR == 1 { print "t,x"; next } { print "\"" $1 "\",\"" $2 "\"" }' commas.csv >quotes.csv
fit 'fit k to "quotes.csv" : t, x'
awk -F, 'NR == 1 { print "t x"; next } { gsub(/e/, "D", $2); print $1 "D0 " $2 }' whole.csv >fortran.csv
fit 'fit k to "fortran.csv" : t, x'
# the time constant of a filter, a state
cat >filter.lag <<'END'
param tau = 0.5
state z' = (sin(3*t) - z)/tau
start z = 1
run 0..3
table z every 0.25 to "filter.csv"
set tau = 0.8
fit tau, z to "filter.csv" : t, z
check tau == 1/2 within 1e-8
END
qdot -q filter.lag 2>&1 | tail -6
# a state that starts at 0, in data without noise: its estimate becomes smaller until the steps end
qdot -q -e 'param k = 4; coord x; particle p mass 1 at x; potential k*x^2/2; state z'"'"' = 2*(x - z); force -z on p; start x = 1; run 0..4; table x, z every 0.25 to "zero.csv"; set k = 4.4; fit k, z to "zero.csv" : t, x, z; check k == 4 within 1e-12' 2>&1 | tail -3
