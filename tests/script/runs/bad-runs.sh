# Runs that cannot be, or cannot go on: what is said of them.
line='coord x
particle p mass 1 at x
'
plane='coord x, y
particle p mass 1 at (x, y)
'
# no digits behind the fourth: they are the method's
told()
{
    qdot -q - 2>&1 | sed 's/\(-\{0,1\}[0-9]\.[0-9]\{4\}\)[0-9]*/\1/g' | sed -n "$1"
}
failed='s/.*failed: stopped at/stopped at/; s/down to [^ ]*/down to H/; s/= [-0-9.e+]* there/= NEAR there/
s/\(, x..\) = [-0-9.]*e+.*/\1 = HUGE/; /^stopped/p'

# a tolerance that a double cannot hold; limits that are one double
for options in 'tol 1e-16' 'tol 1e-400' 'tol 0' 'tol 2'; do
    printf '%srun 0..5 %s\n' "$line" "$options" | told '1p; /hint/p'
done
printf '%srun 1e20..1e20 + 1\n' "$line" | told '1p; /hint/p'

# a run of length 0 is a state; a run back ends where it began
printf "%spotential x^2/2\nstart x = 2, x' = 1\nrun 7..7\nvalue(x, 7)\nvalue(x'', 7)\nmax(x, 7..7)\n" "$line" |
    told '/^run1/p; /steps/p; /value/p; /max/p'
printf "%spotential x^4/4\nstart x' = 1\nrun 0..-20 as a\nstart a\nrun -20..0\ncheck value(x', 0) == 1 within 1e-12\ncheck value(x, 0) == 0 within 1e-12\n" "$line" |
    told '/proved/p; /refuted/p'

# r = 0 in finite time, by every method: where and when; a force of 1/r^3 has no motion beyond
for method in taylor rk8pd dop853 rkf45 bsimp msbdf msadams; do
    printf '%spotential -1/norm(p)^2\nstart x = 1\nrun 0..2 method %s\n' "$plane" $method | told "$failed" | head -n 1
done
printf '%spotential -1/norm(p)^2\nstart x = 1\nrun 0..2 digits 8\n' "$plane" | told "$failed" | head -n 1
printf "%spotential -1/x^2\nstart x = 1, x' = 2\nrun 0..-5\n" "$line" | told "$failed" | head -n 1
# to infinity in finite time
printf "%spotential -x^4/4\nstart x = 1, x' = 1\nrun 0..5\n" "$line" | told "$failed" | head -n 1
# at the singularity itself, and where numbers end: no result is NaN
printf '%spotential -1/x\nrun 0..1\n' "$line" | told '/run1/p; /drift/p; /nan/p'
printf '%spotential x^6/6\nstart x = 1e60\nrun 0..1\n' "$line" | qdot -q --json - 2>&1 | grep -ci 'nan\|inf[^o]'
# V = x^6/6 from x = 0: five of six coefficients vanish; free fall; rest
printf "%spotential x^6/6\nstart x' = 1\nrun 0..30\ncheck value(x, 30) == 0.82685685666415738082 within 1e-13\nrun 0..30 tol 1e-15\ncheck value(x, 30) == 0.82685685666415738082 within 1e-13\n" "$line" |
    told '/proved/p; /refuted/p'
printf "%sgravity -9.81\nstart x = 100, x' = 3\nrun 0..10\ncheck value(x, 10) == -360.5 within 1e-15\nrun 0..1e6\ncheck value(x', 1e6) == 3 - 9.81e6 within 1e-15\n" "$line" |
    told '/proved/p; /refuted/p; /steps/s/ step.*/ step(s)/p'
printf '%spotential x^2/2\nrun 0..1e4\ncheck value(x, 1e4) == 0 within 0\n' "$line" |
    told '/proved/p; /refuted/p; /run1/p'
