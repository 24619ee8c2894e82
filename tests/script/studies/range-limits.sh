# Extrema at points where no value is met state how far their limits are: cusps, kinks, a logarithm
# to a power; what is bounded on the way keeps its digits.
cat >limits.lag <<'END'
coord x
particle p mass 1 at x
start x = -7123/10000, x' = 1
run 0..2
min(abs(x)^(1/3), 0..2)
min(sqrt(abs(x)), 0..2)
min(abs(x)^(1/20), 0..2)
min(abs(x), 0..2)
max(1/log(abs(x)), 1/2..4/5)
max(abs(x)*log(abs(x)), 1/2..4/5)
END
qdot --json limits.lag | awk -F '"(value|error)":' '/"kind":"number"/ {
    value = $2 + 0; error = $3 + 0
    if (value*value > error*error) print "states too little:", $0
    seen++ } END { print seen, "limits of 0" }'
sed -i '/^m[axin]*(/d' limits.lag
cat >>limits.lag <<'END'
max(abs(x)^(1/3), 0..2)
min(abs(x)^(-1/3), 0..2)
max(log(abs(x)), 0..2)
mean(sqrt(abs(x)), 0..2)
END
qdot --json limits.lag | awk -F '"error":' '/"kind":"number"/ {
    if ($2 + 0 > 1e-14) print "states too much:", $0
    seen++ } END { print seen, "beside them" }'
