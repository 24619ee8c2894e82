# the force has begun when the blow comes, but is as small as 1e-15: it pushes the first against the second until t = 8
qdot -q - <<'END' 2>&1 | grep '^proved\|^refuted\|^undecided\|error:'
coord x, y, z
particle a mass 1 at x
particle b mass 1 at y
particle c mass 1 at z
event xy: x = y rising then x' = y', y' = x'
event yz: y = z rising then y' = z', z' = y'
force 2*(8 - t)*exp(-(t - 8)^2) on x
start x = -0.5, x' = 0.25, y = 0, z = 0
run 0..12
events
check value(x', 12) == -0.5 within 1e-6
check value(y', 12) == 0.5 within 1e-12
check value(z, 12) == 2.5 within 1e-12
END
