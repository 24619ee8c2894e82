# Integrals of data, exact by pieces. Independent numbers: SciPy's CubicSpline.integrate (not-a-knot), mpmath from knot to knot.
printf 't,F\n0,1\n1,0.5\n1.5,-1\n3,0.25\n4,2\n6,-0.5\n8,0\n' >drive.csv
printf 'a,v,c\n0,0,1\n0,1,2\n0,2,0\n1,0,3\n1,1,4\n1,2,2\n' >map.csv
qdot -q - <<'END' 2>&1
data drive from "drive.csv" : t, F
data line from "drive.csv" : t, F linear hold
data stairs from "drive.csv" : t, F steps
data map from "map.csv" : a, v, c linear
integral(stairs(t), t, 0.5, 7)
numeric(integral(stairs(t), t, 0.5, 7))
numeric(integral(line(t), t, -10, 20.5), 15)
numeric(integral(line(t), t, 20.5, -10))
numeric(integral(map(t/2, t), t, 0, 2))
END
qdot -q - <<'END' 2>&1
data drive from "drive.csv" : t, F
data line from "drive.csv" : t, F linear
param x
check numeric(integral(drive(t), t, 0, 8)) == 1.1347541224970552 within 1e-14
check numeric(integral(drive(2*t - 1)*sin(t), t, 0.5, 4.5)) == 1.3997961199975808 within 1e-14
check numeric(integral(line(pi*x)^2, x, 0, 2)) == 1.5480455540172494 within 1e-14
END
