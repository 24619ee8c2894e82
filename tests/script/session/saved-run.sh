# A run is saved whole: its multipliers too.
qdot -q - <<'END'
coord x, y
particle b mass 2 at (x, y)
gravity (0, -9)
constraint rod: x^2 + y^2 = 4
start y = -2
run 0..1 as hangs
save hangs to "run.csv"
END
cat run.csv
