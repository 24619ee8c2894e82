# Moving pictures: what stands in the page. Needs no browser.

# What the data of page $1 say, without the numbers of the columns.
data()
{
    sed -n '/application\/json/,/<\/script>/p' "$1" |
        sed '1d;$d; s/"b":[^,]*,"d":"[^"]*"/.../; s/"a":[-0-9.e+]*,/"a":_,/'
}

cat >double.lag <<'END'
param m1, m2, L1, L2, g > 0
coord theta1, theta2
r1 = (L1*sin(theta1), -L1*cos(theta1))
r2 = r1 + (L2*sin(theta2), -L2*cos(theta2))
particle a mass m1 at r1
particle b mass m2 at r2
gravity (0, -g)
set m1 = 1, m2 = 1/8, L1 = 1, L2 = 1, g = 9.81
start theta1 = 2, theta2 = 2
run 0..8
animate to "double.html"
run 0..200 tol 1e-6 as long
animate long from 5 to 15 title "Half <b>" trail 1 speed 1/2 to "part.html"
animate long from 5 to "rest.html"
END
qdot -q double.lag | grep wrote
data double.html | sed 's/tol [0-9e-]*, [0-9]* steps/tol, steps/; s/at most [0-9e-]*/at most/
    s/energy [0-9e-]*/energy/; s/qdot [0-9.]*"/qdot"/'
echo '--- part'
data part.html | sed -n '1,2p'
data rest.html | sed -n '1,2p'
for page in double part rest; do
    tail -n 1 $page.html
done

# A spring and a damper between the same ends; one dimension, upright; a missing run.
qdot -q - <<'END'
param m, k, c, l > 0
coord y
particle box mass m at y
spring s between box, 0 stiffness k rest l
damper d between box, 0 coefficient c
gravity -9.81
set m = 1, k = 40, c = 1/2, l = 1
start y = 1
run 0..5
animate to "box.html"
END
echo '--- box'
data box.html | sed -n '2,7p'

# Bodies: a plank in the plane with its hinge, a top in space.
qdot -q - <<'END'
param m, l, g > 0
coord u
body plank mass m inertia m*l^2/12 at (l/2*sin(u), -l/2*cos(u)) angle u
gravity (0, -g)
set m = 1, l = 2, g = 9.81
start u = 1
run 0..5
animate to "plank.html"
reset
param m, A, C, h, g > 0
coord phi, theta, psi
body top mass m inertia (A, A, C) at (h*sin(theta)*sin(phi), -h*sin(theta)*cos(phi), h*cos(theta)) euler(phi, theta, psi)
gravity (0, 0, -g)
set m = 1, A = 1, C = 1, h = 0.5, g = 9.81
start theta = 0.6, psi' = 20
run 0..5
animate to "top.html"
END
echo '--- plank'
data plank.html | sed -n '1,5p'
echo '--- top'
data top.html | sed -n '1,5p'

# Rods, a spring and a damper between points of two bodies, and from one to the ceiling.
qdot -q - <<'END'
param m, J, k, c, g > 0
coord x[i], y[i], u[i] for i = 1..2
body A mass m inertia J at (x[1], y[1]) angle u[1]
body B mass m inertia J at (x[2], y[2]) angle u[2]
gravity (0, -g)
constraint hang: norm(point(A, (0, 1/2)) - (0, 3)) = 2
constraint rod: norm(point(A, (1/2, -1/2)) - point(B, (-1/2, 1/2)))^2 = 9/4
spring s between point(A, (-1/2, -1/2)), point(B, (-1/2, -1/4)) stiffness k rest 1
damper d between point(A, (1/2, 0)), point(B, (1/2, 1/2)) coefficient c
set m = 1, J = 0.2, k = 20, c = 1, g = 9.81
start y[1] = 0.5, x[1] = 0, u[1] = 0, x[2] = 1.2, u[2] = 0.2
run 0..1
animate to "linked.html"
END
echo '--- linked'
data linked.html | sed -n '2,5p' | sed 's/,"half[^}]*"arms"/ "arms"/g'
