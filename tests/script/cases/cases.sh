# The reference cases, at tolerances from loose to what a double can hold: the true error of the
# end state is at most 3 times the stated one, and the stated one at most 100 times the true one
# where that is above 1e-14 and the stated one above what rounding makes of the scene (below, the true one
# may be 0 by chance); at 1e-15 it is what rounding makes of it. With `digits 30` the quick ones have 28.
scene()
{
    sed -n "/^### $1\$/,/^### /p" cases.inc | sed '/^###/d'
}
# check value(KEY, END) == REFERENCE, a line each
values()
{
    sed -n "/\"case\":\"$1\"/s/.*\"values\":{\([^}]*\)}.*/\1/p" cases.json | sed 's/,"/\
"/g' | sed -n "s/^\"\(.*\)\":\"\(.*\)\"/check value(\1, $2) == \2 within 1e-28/p"
}
for name in $(sed -n 's/^### //p' cases.inc); do
    end=$(sed -n "s/.*\"case\":\"$name\",\"t_end\":\"\([^\"]*\)\".*/\1/p" cases.json)
    echo "### $name"
    {
        scene "$name"
        printf "run 0..$end tol %s\n" 1e-4 1e-8 1e-13 1e-15
        case $name in
        double-pendulum-5 | duffing | foucault | henon-heiles | rotating-hoop | swinging-atwood | \
            pendulum-cartesian | double-pendulum-cartesian-5 | knife-edge | car-axis)
            echo "run 0..$end digits 30"
            values "$name" "$end"
            ;;
        esac
    } | qdot -q --json -
done >answers
awk -f cases.awk cases.json answers
