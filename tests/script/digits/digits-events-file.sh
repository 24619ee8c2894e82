# A run with `digits` in a file: the state on either side of an event, each to its digits.
qdot -q -e 'param g = 10, e = 1/2; coord y; particle b mass 1 at y; force -g on b; start y = 1' \
    -e "event hit: y = 0 falling then y' = -e*y'" -e 'run 0..1 digits 25 as d; save d to "d.csv"' >/dev/null
# v = sqrt(20) before, half of it behind, twice
awk -F, 'NR > 1 && $2 == "0" { print $0 }' d.csv
# a switch of the equations is no event: its two rows agree
qdot -q -e 'coord x; particle b mass 1 at x; force -sign(x) on b; start x = 1; run 0..2 digits 20 as s' \
    -e 'save s to "s.csv"' >/dev/null
awk -F, 'NR > 1 && $1 == t { print t, x == $2 ? "x agrees" : x " " $2, v == $3 ? "v agrees" : v " " $3 } { t = $1; x = $2; v = $3 }' s.csv
