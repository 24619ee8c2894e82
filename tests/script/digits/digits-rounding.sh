# What is printed of a number with `digits` lies within the error beside it, where the digits leave out more than the run's
# error does. Truth: parts of circles about 1.6 and -1.6 (mpmath, 60 digits: ...3962199934287193).
qdot -q - <<'END' 2>&1 | awk '/^value/ { print $3, $4; print ($6 >= 6.6e-27 && $6 < 1e-25 ? "covers" : "too small: " $6) }'
coord x
particle b mass 1 at x
potential x^2/2
force 1.6*sign(sin(t)) on x
start x = 0.4, x' = 2.789
run 0..5 digits 25
value(x, 5)
END
