# Unstable periodic orbits from guesses of two digits: multiple shooting. Against SciPy, DOP853 with rtol 1e-13 and
# fsolve on the half orbit.
cat >moon.lag <<'END'
param mu = 0.012150585609624
coord x, y, z
r1 = sqrt((x + mu)^2 + y^2 + z^2)
r2 = sqrt((x - 1 + mu)^2 + y^2 + z^2)
lagrangian ((x' - y)^2 + (y' + x)^2 + z'^2)/2 + (1 - mu)/r1 + mu/r2
END
numbers='s/= [-0-9.e]* ± [0-9.e-]*/= N ± ERROR/'

# one of the family about L1, near the guess; the one through a given x
qdot -q moon.lag - <<'END' 2>&1 | sed "$numbers"
find x = 0.84, y' = 0.1, T = 2.7 such that returns after T
check value(x, 0) == 0.827 within 0.002
check value(y', 0) == 0.09 within 0.02
start x = 0.8261
find y' = 0.1, T = 2.7 such that returns after T
check value(y', 0) == 0.0987300360386536649 within 1e-13
param P
find y' = 0.1, P = 2.7 such that returns after P
check value(P, 0) == 2.72218175705373697 within 1e-12
END

# Lyapunov orbits about L1, small to large, of NASA/JPL's catalogue of Three-Body Periodic Orbits (ssd.jpl.nasa.gov)
qdot -q moon.lag - <<'END' 2>&1 | sed "$numbers"
param P
set mu = 1.215058560962404e-2
start x = 0.830023864314168
find y' = 0.06, P = 2.7 such that returns after P
check P == 2.702881200253821 within 1e-11
check value(y', 0) == 0.06088309999599009 within 1e-12
start x = 0.8007325761918545
find y' = 0.35, P = 3.3 such that returns after P
check P == 3.297097386764505 within 1e-12
check value(y', 0) == 0.35248700747556716 within 1e-12
start x = 0.7076756180347542
find y' = 0.62, P = 5.7 such that returns after P
check P == 5.709795908302705 within 1e-12
check value(y', 0) == 0.621513254358129 within 1e-12
END

# halos about L1 and L2; one that nearly falls on the Moon
qdot -q moon.lag - <<'END' 2>&1 | sed "$numbers"
start z = 0.05
find x = 0.82, y' = 0.14, T = 2.7 such that returns after T
check value(x, 0) == 0.823844660756626 within 1e-11
check value(y', 0) == 0.159703975128711 within 1e-10
start z = 0.02
find x = 1.12, y' = 0.18, T = 3.4 such that returns after T
check value(x, 0) == 1.117458089412877 within 1e-10
check value(y', 0) == 0.184509901302311 within 1e-9
start z = -0.18
find x = 1.02, y' = -0.1, T = 1.5 such that returns after T
check value(x, 0) == 1.01909613581404 within 1e-11
END

# a driven pendulum about its top: theta = -0.1/(9.8 + 9) cos(3 t) to first order
qdot -q - <<'END' 2>&1 | sed "$numbers"
coord theta
lagrangian theta'^2/2 - 9.8*cos(theta) + 0.1*cos(3*t)*theta
find theta = 0.01, theta' = 0 such that returns after 4*pi/3
check value(theta, 0) == -0.1/18.8 within 1e-6
END

# a drive about the top in three turns: a single run has lost all but three digits by their end
qdot -q - <<'END' 2>&1 | sed "$numbers"
coord th
lagrangian th'^2/2 - 9.81*cos(th)
force -0.2*th' + 3*cos(2*t) on th
find th = -0.2, th' = 0 such that returns after 3*pi
check value(th, 0) == -0.218061012692907 within 1e-11
check value(th', 0) == 0.012743090904497 within 1e-11
END

# pendulums: one of a family along which the slopes hardly tell one from another, T = 4 K(sin(theta/2)) near the guess
qdot -q - <<'END' 2>&1 | sed "$numbers"
coord theta
lagrangian theta'^2/2 + cos(theta)
find theta = 1, T = 6.7 such that returns after T
check value(theta, 0) == 1 within 1e-3
find theta = 3.14, T = 34 such that returns after T
check value(theta, 0) == 3.14 within 1e-3
END

# near the top the angle hardly moves when the pendulum comes back: slopes of it are rounding; T = 4 K(sin(theta/2))
qdot -q --json - <<'END' 2>&1 | sed -n 's/.*"name":"\([a-zT]*\)","value":\([0-9.]\{7\}\).*/\1 \2/p'
coord theta
lagrangian theta'^2/2 + cos(theta)
find theta = 3, T = 16 such that returns after T
END

# y = x' = 0 on no orbit of Henon and Heiles: the search shrinks the motion until it comes back within its errors
qdot -q - <<'END' 2>&1 | sed 's/to x = .*/to .../'
coord x, y
lagrangian (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y + y^3/3
find x = 0.2, y' = 0.2, T = 6.3 such that returns after T
END

# far from its guess, small and alone: a drive moves it so, (x, x') = (-3, 2)/50
qdot -q --json - <<'END' 2>&1 | sed -n "s/.*\"name\":\"\(x'*\)\",\"value\":\(-*[0-9.]*\),.*/\1 \2/p" | awk '{printf "%s %.9f\n", $1, $2}'
coord x
lagrangian x'^2/2 - x^2/2
force -x'/2 + cos(2*t)/5 on x
find x = 5, x' = 0 such that returns after pi
END

# a drive about the top in three turns: its run comes back within its error only; multipliers by segments, the third powers of those
# of one turn (SciPy: 12992.056123, 4.106263751e-5)
qdot -q --json - <<'END' 2>&1 | sed -n 's/.*"name":"\(floquet.[12].\)","value":\([0-9.]\{8\}\).*/\1 \2/p'
coord th
lagrangian th'^2/2 - 9.81*cos(th)
force -0.2*th' + 3*cos(2*t) on th
start th = -0.21806101269290711805, th' = 0.01274309090449789140
run 0..3*pi tol 1e-12
floquet
END

# Newton's method stops on the way to the larger of a driven oscillator's orbits, to which the guess comes by itself (SciPy, from
# rest over 60 periods: 0.902702, 0.529732)
qdot -q - <<'END' 2>&1 | sed 's/\(0\.[0-9]\{10\}\).*/\1/; s/after [0-9]* returns$/after some returns/'
coord x
lagrangian x'^2/2 - x^2/2 - x^4/4
force -x'/10 + 3/10*cos(1.2*t) on x
find x = 0.1, x' = 0.1 such that returns after 2*pi/1.2
END
