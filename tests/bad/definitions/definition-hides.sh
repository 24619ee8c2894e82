# A definition never hides the language, a label or a coordinate: an error with the line that was meant.
scene='param m, g, l, k > 0; coord theta, x, y; particle bob mass m at (x, y); spring s1 between bob, (0, 0) stiffness k
'
for line in 'potential = -k/x' 'gravity = 9.81' "lagrangian = m*x'^2/2" 'force = -k*x' 'lambda = 3' 'pi = 3' 'bob = (1, 2)' 's1 = 3' \
    "theta' = 2" 'theta = sin(x)' "theta'' = -g/l*sin(theta)" 'eom[theta] = 0' 'm(t) = t' "x' = 1 for k = 1..2" \
    'cos(u) = u' 'x = y = 2' 'bob(u) = u' 's1(u) = u' 'theta[1] = 3' 'force = -k*x on x' 'torque = k for k = 1..2'; do
    qdot -q -e "$scene$line"
done
# Nothing was declared by it.
qdot -q -e "coord x; particle a mass 1 at x" -e 'potential = x^2' -e 'V' -e 'potential x^2' -e 'V'
