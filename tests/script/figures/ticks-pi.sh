# Axes of angles: tics at multiples of pi, of the abscissa, against time of the ordinate, or of the axes that are said.
scene='coord theta; particle a mass 1 at (sin(theta), -cos(theta)); gravity (0, -9.81); start theta = 3; run 0..6'
qdot -q -e "$scene" -e 'plot theta ticks pi keep to "time.svg"' -e "plot theta' vs theta ticks pi keep to \"phase.svg\"" \
    -e 'plot theta, 2*theta ticks pi xy keep to "both.svg"' -e 'plot theta | plot theta ticks pi y keep to "two.svg"' \
    -e "plot theta' vs theta | plot theta'' vs theta ticks pi keep to \"apart.svg\"" |
    grep wrote
qdot -q -e 'plot cos(x) vs x = 0..20*pi ticks pi keep to "turns.svg"' -e 'plot cos(x) vs x = 0..pi/3 ticks pi keep to "part.svg"' \
    -e 'plot x vs x = 0..1/100 ticks pi keep to "small.svg"'
qdot -q -e "$scene" -e "sweep theta = -3..3 count 5, theta' = 0..1 count 3 run 0..1 : energy" \
    -e 'plot sweep1 ticks pi keep to "map.svg"' | grep wrote
for name in time phase both two apart turns part small map; do
    echo "$name"
    grep '^set [xy]tics (' $name.gp 2>&1
done
qdot -q -e "$scene" -e 'plot theta ticks 2 to "n.svg"'
# A logarithmic axis has none, nor has a figure without an angle.
qdot -q -e 'plot x vs x = 1..100 log x ticks pi to "n.svg"'
qdot -q -e 'plot x vs x = 1..100 log xy ticks pi xy to "n.svg"'
qdot -q -e 'plot x vs x = 1..100 log y ticks pi x to "log.svg"'
qdot -q -e "$scene" -e 'plot drift(energy) ticks pi to "n.svg"' 2>&1 | tail -4
qdot -q -e "$scene" -e 'race 0..1 ticks pi' 2>&1 | tail -4
qdot -q -e "$scene" -e 'workprecision 0..1 ticks pi y to "n.svg"' 2>&1 | tail -4
qdot -q -e "$scene" -e 'longtime 0..100 ticks pi' 2>&1 | tail -4
