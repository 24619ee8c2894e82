# Forces whose terms cancel, against 25 digits: runs and their companions round them alike. What is stated of
# the end, of accelerations and of what is read along the run must hold, alone and in a sweep.
check()
{
    awk -v what="$1" -v least="$2" '
        { n++; d = $1 - $3; if (d < 0) d = -d; if (!(d <= 3 * $2)) print what ": " $0 }
        END { print what ": " (n < least ? "only " n : "all") " values compared" }'
}

numbers()
{
    sed -n 's/^{"kind":"number".*"value":"*\([-+0-9.e]*\)"*,"error":\([-+0-9.e]*\).*/\1 \2/p'
}

scene()
{
    name=$1 force=$2 start=$3 end=$4
    text="coord x
particle p mass 1 at x
force $force on p
start $start"
    asked="value(x, $end)
value(x', $end)
value(x'', $end*2/3)
value(1000*($force), $end*3/4)"
    right=$(printf '%s\n' "$text" "run 0..$end digits 25" "$asked" | qdot -q --json - | numbers | sed 's/ .*//')
    for how in 'taylor tol 1e-12' 'taylor tol 1e-6' 'dop853 tol 1e-12' 'radau tol 1e-12' 'gauss6 tol 1e-9' 'taylor tol 1e-15'; do
        printf '%s\n' "$text" "run 0..$end method $how" "$asked" | qdot -q --json - | numbers >got
        echo "$right" | paste -d' ' got -
    done | check "$name" 24
}

scene 'cosine' 'cos(x) - 1' 'x = 1e-5' 1
scene 'hyperbolic tangent of a root' 'tanh(sqrt(1 + x^2))^3 - tanh(1)^3' 'x = 1e-5' 1
scene 'exponential' '1 - exp(x)' 'x = 1e-7' 3
scene 'decay from 1' "1 - exp(x) - x'" 'x = 1' 40
scene 'sine' 'sin(x) - x' "x = 1e-4, x' = 1e-5" 4
scene 'root' '1 - sqrt(1 + x)' 'x = 1e-6' 2
scene 'logarithm' 'log(1 + x)' 'x = -1e-8' 2
scene 'relativistic' "-x*sqrt(1 - x'^2) + x - x^3" "x = 1e-4, x' = 1e-4" 2
scene 'far away' 'sqrt(x^2 + 1) - x' 'x = 1e6' 1
scene 'by a large factor' '1e4*(cos(x) - cosh(x))' 'x = 1e-5' 1

echo '# a sweep: members side by side'
starts='0.001 0.002 0.003 0.004 0.005 0.006 0.008 0.01 0.015 0.02 0.025 0.03 0.035 0.04 0.045 0.05 0.07 0.1'
cosine='coord x
particle p mass 1 at x
force cos(x) - 1 on p'
for x in $starts; do
    echo "start x = $x"
    printf '%s\n' 'run 0..1 digits 25' "value(x', 1)" 'value(1e6*(cos(x) - 1), 1)'
done >runs
{ echo "$cosine"; cat runs; } | qdot -q --json - | numbers | sed 's/ .*//' >right
printf '%s\n' "$cosine" 'param a' 'start x = a' \
    "plan sweep a = [$(echo $starts | sed 's/ /, /g')] run 0..1 : x', 1e6*(cos(x) - 1)" \
    "sweep a = [$(echo $starts | sed 's/ /, /g')] run 0..1 : x', 1e6*(cos(x) - 1) as s" \
    'save s to "s.csv"' | qdot - | sed -n 's/,.*//; /^each/p'
tail -n +2 s.csv | awk -F, '{ print $2, $4; print $3, $5 }' | paste -d' ' - right | check 'members' 36
