# What has no Taylor series at the point says so.
for e in 'abs(x)' 'sign(x)' 'floor(x)' 'mod(x, 2)' 'max(x, 2*x)' 'if(x > 0, x, 2*x)' 'abs(sin(x)/x - 1)' \
    'sqrt(x)' 'x^(3/2)' 'x^a' 'log(x)' 'x*log(x)' '1/x' 'exp(1/x)' 'sin(x)/y' 'x*y/(x^2 + y^2)' \
    'sqrt(x^2 + y^2)' 'atan2(y, x)' 'sqrt(1 - cos(x))'; do
    qdot -q -e "coord x, y; param a; series($e, x = 0, y = 0, 3)" 2>&1 | head -1
done
