# Axes of angles: tics at multiples of pi, of the abscissa, against time of the ordinate, or of the axes that are said.
scene='coord theta; particle a mass 1 at (sin(theta), -cos(theta)); gravity (0, -9.81); start theta = 3; run 0..6'
qdot -q -e "$scene" -e 'plot theta ticks pi keep to "time.svg"' -e "plot theta' vs theta ticks pi keep to \"phase.svg\"" \
    -e 'plot theta, 2*theta ticks pi xy keep to "both.svg"' -e 'plot theta | plot theta ticks pi y keep to "two.svg"' \
    -e "plot theta' vs theta | plot theta'' vs theta ticks pi keep to \"apart.svg\"" |
    grep wrote
qdot -q -e 'plot cos(x) vs x = 0..20*pi ticks pi keep to "turns.svg"' -e 'plot cos(x) vs x = 0..pi/3 ticks pi keep to "part.svg"' \
    -e 'plot x vs x = 0..1/100 ticks pi keep to "small.svg"' -e 'plot x vs x = 1..100 log x ticks pi keep to "log.svg"'
qdot -q -e "$scene" -e "sweep theta = -3..3 count 5, theta' = 0..1 count 3 run 0..1 : energy" \
    -e 'plot sweep1 ticks pi keep to "map.svg"' | grep wrote
for name in time phase both two apart turns part small log map; do
    echo "$name"
    grep '^set [xy]tics (' $name.gp 2>&1
done
qdot -q -e "$scene" -e 'plot theta ticks 2 to "n.svg"'
