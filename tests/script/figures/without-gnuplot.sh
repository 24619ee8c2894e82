# Where gnuplot is missing a .svg is drawn all the same; other kinds say what is missing.
program=$(command -v qdot)
PATH=$PWD
scene='coord theta; particle p mass 1 at (sin(theta), -cos(theta)); gravity (0, -9.81); start theta = 1; run 0..2'
"$program" -q -e "$scene; plot theta, theta' to \"a.svg\"; plot p to \"b.svg\" keep; plot x vs x = 0..1 to \"c.png\""
for name in a b; do
    while read -r line; do
        case $line in
        '<svg xmlns'*) echo "$name: ${line%% font*}" ;;
        *θ*) echo "$name: ${line#*>}" ;;
        esac
        last=$line
    done <$name.svg
    echo "$name ends with $last"
done
while read -r line; do
    case $line in
    'set output'*) echo "$line" ;;
    esac
done <b.gp
