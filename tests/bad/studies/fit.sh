# What a fit cannot be made of: its words, its data file, its unknowns.
scene='param m, k > 0, g; coord theta, x > -5; particle a mass m at (x, sin(theta)); potential k*x^2/2; set m = 1, k = 2; start x = 1'
printf 't,x\n0,1\n0.5,0.8\n1,0.2\n1.5,-0.5\n' >data.csv
try()
{
    qdot -q -e "$scene" -e "$1" 2>&1 | sed '/^undone/d'
}
while read -r line; do
    try "$line"
done <<'EOF'
fit
fit m
fit kk to "data.csv" : t, x
fit k, k to "data.csv" : t, x
fit g to "data.csv" : t, x
fit k to data : t, x
fit k to "data.csv"
fit k to "data.csv" :
fit k to "data.csv" : x, theta
fit k to "data.csv" : t*1000, x, t/2
fit k to "data.csv" : t^2, x
fit k to "data.csv" : t
fit k to "data.csv" : t, skip
fit k to "data.csv" : t,
fit k to "data.csv" : t, sigma
fit k to "data.csv" : t, zeta
fit k to "data.csv" : t, (x, theta)
fit k to "data.csv" : t, value(x, 1)
fit k to "data.csv" : t, t
fit k to "data.csv" : t, x, theta
fit k to "data.csv" : t
fit k to "data.csv" : t, x sigma 0
fit k to "data.csv" : t, x sigma 0.1, 0.2
fit k to "data.csv" : t, x sigma 0.1 sigma 0.2
fit k to "data.csv" : t, x, sigma sigma 0.2
fit k to "data.csv" : t, x, sigma, theta
fit k to "data.csv" : t, x tol 2
fit k to "data.csv" : t, x method rkf45
fit k to "data.csv" : t, x as m
fit k to "data.csv" : t, x from 1
fit k to "none.csv" : t, x
fit k to "." : t, x
fit theta to "data.csv" : t, x
fit m, k, x, x', theta to "data.csv" : t, x
EOF
# the file: each a place, and what to do
data()
{
    printf "$1" >bad.csv
    try "fit k to \"bad.csv\" : ${2:-t, x}" | grep -v '^  *fit\|^  *^'
}
data ',1\n1,\n'
data 't,x\r\n0,1\r\n\r\n1,two\r\n'
data '0,1\n1,nam\n'
data '0,1\n1,2,3\n'
data '0,1\n1\n'
data '0;1,5\n0.5;1\n'
data '0;1.000,5\n'
data '\377\376t\n'
data ''
data 'a,b\n'
data '0,1\n-1,2\n'
data '0,1,0.1\n1,2,0\n' 't, x, sigma'
data '0,1\n1,2\n' 't, x, sigma'
data '0,1,2,3\n1,2,2,3\n'
data '0,1e400\n'
data 'theta,t\n1,0\n0.8,0.5\n'
data "# measured\nt;x'\ns;m/s\n0;1\n0.5;0.8\n"
# a sum that no step makes less; a run that ends before the data do; a guess outside a domain
printf '0,1\n1,2\n2,300\n3,-7\n4,11\n' >wild.csv
try 'param w = 1; potential x*cos(w*t); fit w, x to "wild.csv" : t, x'
try 'event end: x = 0.5 falling stop; fit k to "data.csv" : t, x'
try 'set k = 2; potential -1e9*x^4; fit k to "data.csv" : t, x'
# a chaotic run has no numbers to compare beyond its horizon
cat >double.lag <<'EOF'
param g = 9.81
coord a, b
r = (sin(a), -cos(a))
particle p mass 1 at r
particle q mass 1 at r + (sin(b), -cos(b))
gravity (0, -g)
start a = 2, b = 2
EOF
qdot -q double.lag -e 'run 0..60; table a every 1 to "double.csv"' >double.txt
qdot -q double.lag -e 'fit g to "double.csv" : t, a sigma 0.01' 2>&1 | sed 's/ = [0-9.]*,/ = T,/; s/> [0-9.]*/> T/'
# equations that jump
try "param mu = 0.1; force (-mu*sign(x'), 0) on a; fit mu to \"data.csv\" : t, x"
