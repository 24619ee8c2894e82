# Events of motions that decay below what is known of them: what came before stands, the rest is not known. The times
# from which on it is not are those of rounding.
from_then() {
    qdot -q - 2>&1 | sed 's/from t = [0-9.]*/from t = T/g'
}
over='coord x
particle a mass 1 at x
potential x^2/2
dissipation 3*x'"'"'^2
event in: x = 0
start x = 1
'
# overdamped: x > 0 for ever
printf '%srun 0..200 method dop853\nevents\nin[1]\n' "$over" | from_then | grep -v '^run\|^ '
printf '%srun 0..1000\nevents\nrun 0..400 method radau\nevents\n' "$over" | from_then | grep -v '^run\|^ '
printf '%srun 0..1000\nevents\n' "$over" | qdot -q --json - | grep '"notice"\|"numbers"' |
    sed 's/from t = [0-9.]*/from t = T/; s/,"statement.*}/}/'
# a crossing in every 4 pi/sqrt(3), exp(-t/2): seen down to rounding, at t = 71.34
printf 'coord x\nparticle a mass 1 at x\npotential x^2/2\ndissipation 0.5*x'"'"'^2\nevent in: x = 0 rising\nstart x = 1\nrun 0..300\ncheck in[9] - in[1] == 32*pi/sqrt(3) within 1e-8\nin[20]\n' |
    from_then | sed 's/: [0-9]* occ/: N occ/' | grep -v '^run\|^ '
# the points of a section end there
printf 'coord th\nlagrangian th'"'"'^2/2 + 10*cos(th)\ndissipation th'"'"'^2\nstart th = 1\nrun 0..200\npoincare th = 0 rising : th'"'"'\n' |
    from_then | grep 'notice\|1.73280\|22.677786'
# what is held at a contact has not decayed
printf 'coord y\nparticle p mass 1 at (0, y)\ngravity (0, -10)\nevent hit: y = 1 falling then y'"'"' = -y'"'"'/2\nevent low: y = 1\nstart y = 2\nrun 0..5\nevents\n' |
    from_then | grep 'equal' | wc -l
