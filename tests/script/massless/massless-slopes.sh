# A massless point between two springs and a damper: slopes are the matrix exponential, exponents its eigenvalues (SciPy:
# 0.1519006994 -0.3089467823 0.4196070349; -0.5698402910, -0.2150798545 twice), whether or not the start names y'.
for start in '' ", y' = 0"; do
    qdot -q - <<END 2>&1 | grep '^d(\|^lyapunov' | sed 's/ ± .*//; s/\([0-9]\.[0-9]\{10\}\)[0-9]*/\1/'
coord x, y
particle p mass 1 at y
dissipation (x' - y')^2/2
force -x on x
force -y on y
start x = 1, y = 0.5$start
run 0..1
sensitivity value(x, 1) of x, y, y'
END
done
qdot -q - <<'END' 2>&1 | sed 's/\(-0\.[0-9][0-9]\).*/\1/'
coord x, y
particle p mass 1 at y
dissipation (x' - y')^2/2
force -x on x
force -y on y
start x = 1, y = 0.5
lyapunov spectrum 0..400
END
