# what is drawn may begin with a word that is an option of figures, too
for text in 'plot log(x) vs x = 1..3' 'plot log(x), log(2*x) vs x = 1..3 log x' 'param title; plot title^2 vs title = 0..1 title "squares"' \
    'param range; plot range vs range = 0..1 range 0..2' 'param size; plot size^2 vs size = 1..2 size 4, 3' \
    'plot x vs x = 1..2 | plot log(x) vs x = 1..2' 'param k; plot log(k*x) vs x = 1..2 for k = 1..2'; do
    qdot -q -e "$text to \"a.svg\""
done
qdot -q -e 'coord keep; lagrangian keep'"'"'^2/2; start keep = 1; run 0..1 to "run.txt"' -e 'plot keep keep to "a.svg"' -e 'plot log(keep + 2) vs keep log y to "a.svg"'
# an index that no curve reads, though the scene does
qdot -q -e 'param k; coord u; lagrangian u'"'"'^2/2 + k*u; plot u vs u = 0..1 for k = 1..2 to "a.svg"'
