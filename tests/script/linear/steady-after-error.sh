# A `steady in` that fails leaves the list of before: steady[1] stays what was answered.
qdot --json -i 2>/dev/null >after-error.json <<'END'
param m, l, g > 0
coord 0 < theta < pi, phi
particle b mass m at (l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta))
gravity (0, 0, -g)
steady
steady in theta
steady[1]
steady in phi'
steady in theta
steady[1]
linearize at steady[1]
END
grep -o '"name":"[a-z]*\[[^}]*"plain":"[^"]*"\|"message":"`[^"]*"' after-error.json
