# A velocity constraint that is not linear has no direction where the velocities are 0: under
# gravity this particle comes there, turning ever faster, and every run stops.
scene="coord x, y, z; particle p mass 2 at (x, y, z); gravity (0, 0, -9.81); potential x^2/2
constraint cone: x'^2 + y'^2 = z'^2
start x = 0.3, x' = 0.6, y' = 0.8, z' = 1"
qdot -q -e "$scene
run 0..0.19
check value(x'^2 + y'^2 - z'^2, 0.19) == 0 within 1e-15" | tail -1
for how in '' 'method rk8pd' 'constraints none' 'digits 12'; do
    qdot -q -e "$scene
    run 0..0.5 $how" 2>/dev/null | sed -n 's/.*stopped/stopped/; s/\(0\.20185\)[0-9]*/\1/; /^stopped/p'
done
# At rest nothing says where to.
qdot -q -e "$scene
start x' = 0, y' = 0, z' = 0
run 0..0.5" 2>&1 | sed -n '/error/,$p'
