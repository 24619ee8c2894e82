# Problems of books and of another program's tests, each a scene with the answer that the book prints (BOOK.inc, a section
# each). Right: every statement succeeds, every check is proved.
for file in landau.inc goldstein.inc sicm.inc sympy.inc; do
    book=${file%.inc}
    for name in $(sed -n 's/^### //p' $file); do
        sed -n "/^### $name\$/,/^### /p" $file | sed '/^###/d' >problem.lag
        if ! qdot -q problem.lag >answers 2>errors; then
            verdict=$(cat answers errors | sed -n '/^refuted/{s/ at .*//p;q;};s/.*error: //p' | head -n 1)
        elif grep -q '^undecided' answers; then
            verdict=undecided
        else
            verdict=right
        fi
        echo "$book $name: $verdict"
    done
done >verdicts
grep -v ': right$' verdicts
for book in landau goldstein sicm sympy; do
    awk -v book=$book '$1 == book { n++; right += / right$/ } END { print book ": " right " right of " n }' verdicts
done
