# Sections of runs: every crossing, with numbers there and their errors.
same='s/in [0-9.e-]* s/in S/; s/  */ /g; s/^ //' # what is compared
cat >two.lag <<'END'
param w = 2
coord x, y
particle p mass 1 at (x, y)
potential x^2/2 + w^2*y^2/2
start x = 1, y = 1
END
echo '# x = cos t, y = cos(2 t): the distance from the closed form is at most sqrt(2) times each error'
qdot -q --json two.lag -e 'run 0..1000' -e "poincare x = 0 rising : y, y', x'" | grep '"row"' | awk -F'[][,]' '
    /"poincare"/ { n++; t = (4*n - 1)*2*atan2(1, 1)
        if (($4 - t)^2 > 2*$10^2 || ($5 + 1)^2 > 2*$11^2 || $6^2 > 2*$12^2 || ($7 - 1)^2 > 2*$13^2) bad++
        if ($10 + $11 + $12 + $13 > 1e-11) wide++ }
    END { print n, "crossings,", bad + 0, "outside,", wide + 0, "wide" }'
echo '# ways, named equations, a run made for it, part of the time, backwards'
qdot -q two.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v -e steps -e cpu -e error -e drift
run 0..7 as forth
poincare x = 0 : y, x' as both
poincare x == 1/2 falling : t, y*w
edge = (y = 0)
poincare edge rising : x from 3 to 6
poincare x = 1 : y
poincare x = 2 : y
poincare x' = 0 falling : x run 0..-20 tol 1e-9 as back
table both
END
echo '# at events, jumps and switches: once each'
qdot -q - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v -e steps -e cpu -e error -e drift
coord z
particle b mass 1 at z
gravity -2
event bounce: z = 0 falling then z' = -z'
start z = 1
run 0..4.5
poincare z = 0 : z'
poincare z' = 0 : z
remove bounce
force -2*sign(z) on b
remove gravity
run 0..6
poincare z = 0 : z'
poincare z = 0 falling : z'
poincare z = -1 : z
END
echo '# of a sweep: its runs are made again'
qdot -q two.lag - <<'END' 2>&1 | awk -f six.awk | sed "$same"
sweep w = 1..3 step 1 run 0..10 tol 1e-9 : y as curve
poincare x = 0 rising : y of curve as all
poincare x = 0 : y of curve from 4 to 6
poincare x = 0 : 1/(w - 2), y of curve
plot all to "all.svg"
save all to "all.csv"
undo
undo
table all
END
awk -f six.awk all.csv | sed "$same" | head -3
echo '# chaos: points beyond the horizon have no digits of their own'
qdot -q --json - <<'END' 2>&1 | awk '/horizon of their run/ { told++ } /"row"/ { n++; if (/"errors":\[null/) unknown++ } END { print told, (n > 50), (unknown > 50) }'
coord th1, th2
particle a mass 1 at (sin(th1), -cos(th1))
particle b mass 1 at (sin(th1) + sin(th2), -cos(th1) - cos(th2))
gravity (0, -9.81)
start th1 = 2, th2 = 2
run 0..200 tol 1e-9
poincare sin(th1) = 0 rising : th2, th2'
END
echo '# through poles, in the coordinates of the scene'
qdot -q - <<'END' 2>&1 | awk -f six.awk | sed "$same" | grep -v -e steps -e cpu -e error -e drift
coord r > 0, phi
particle p mass 1 at (r*cos(phi), r*sin(phi))
potential r^2/2
start r = 1, phi = 1
run 0..7
poincare r = 1/2 : phi, r'
END
echo '# times that the run does not have'
qdot -q - <<'END' 2>&1 | grep notice
coord theta
lagrangian theta'^2/2 + cos(theta)
start theta = 1
run 0..5
poincare theta = 0 : theta' from 2 to 40
poincare theta = 0 : theta' from 4 to 2
END
