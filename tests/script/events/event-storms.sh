# Functions that jump 1e9 times in a run: their parts are counted, and the run is given up soon;
# what came before stays.
scene='coord x
particle p mass 1 at x
'
told() {
    grep -o 'an event or switch changes so fast that 20000 parts of steps were searched\|events come'
}
printf "%sevent a: floor(1e9*x)*x = 0.5e9 then x' = -x'\nstart x' = 1\nrun 0..1\n" "$scene" | qdot -q - 2>&1 | told
printf "%sevent a: x + floor(1e9*t) = 5e8\nstart x' = 1\nrun 0..1\n" "$scene" | qdot -q - 2>&1 | told
printf "%sevent a: sin(1e9*x) = 0\nstart x' = 1\nrun 0..1\n" "$scene" | qdot -q - 2>&1 | told
