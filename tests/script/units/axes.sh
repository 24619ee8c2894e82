# Axes of figures have the units of what they show: one for each label where these differ.
cat >axes.lag <<'EOF'
param m > 0 [kg], l > 0 [m], g > 0
coord theta [rad]
particle bob mass m at (l*sin(theta), -l*cos(theta))
gravity (0, -g)
set m = 1 [kg], l = 50 [cm], g = 9.81 [m/s^2]
start theta = 30 [deg]
run 0..2
plot theta, theta' to "two.tikz"
plot theta'' to "one.tikz"
plot theta' vs theta to "phase.tikz"
plot (l*sin(theta), -l*cos(theta)) to "path.tikz"
plot m*g*l*(1 - cos(theta)) vs theta = -1..1 to "over.tikz"
plot theta' xlabel "time" to "own.tikz"
plot energy, sin(theta) to "number.tikz"
EOF
qdot -q axes.lag | grep -c wrote
for figure in two one phase path over own number; do
    echo "$figure:"
    grep -o '[xy]label={[^}]*}.*' $figure.tikz
done
# without units there are none
cat >plain.lag <<'EOF'
coord x
lagrangian x'^2/2 - x^2/2
start x = 1
run 0..2
plot x' to "plain.tikz"
EOF
qdot -q plain.lag | grep wrote
grep -o '[xy]label={.*' plain.tikz
# an animation: the time, the axes of the phase portrait, energies, values of parameters
sed -e '/^plot/d' axes.lag >moving.lag
echo 'animate to "moving.html"' >>moving.lag
qdot -q moving.lag | grep wrote
grep -o '"unit":"[^"]*"\|"states":.*\|"energies":.*\|"with",[^]]*' moving.html
