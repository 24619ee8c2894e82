# What conditions do not fix, and what they do not let be: no solution out of reach, families, zeros of higher order.
cat >oscillator.lag <<'END'
coord x
particle p mass 1 at x
potential x^2/2
start x = 1
END
ask() {
    qdot -q "$@" 2>&1 | grep -v '^  ' | sed 's/-*[0-9][-.0-9e]* ± [0-9.e-]*/N ± ERROR/; s/= [0-9.e-]*, where the cond/= N, where the cond/'
}
# cos T is never less than -1: nearest at an odd multiple of pi
ask oscillator.lag -e "find T = 1 such that value(x, T) = -1.0001"
ask oscillator.lag -e "find T = 1 such that value(x, T) = 5"
# all motions return, at rest only after another time; then both unknowns are fixed
ask oscillator.lag -e "find x = 0.5 such that returns after 2*pi"
ask oscillator.lag -e "find x = 0.5, x' = 0.3 such that returns after 2*pi"
ask oscillator.lag -e "find x = 0.5, x' = 0.3 such that returns after 5"
# an ellipse has an end: T grows no farther than a search may cost
ask - <<'END'
coord x, y
particle p mass 1 at (x, y)
potential -1/sqrt(x^2 + y^2)
start x = 1, y' = 1.2
find T = 1 such that value(sqrt(x^2 + y^2), T) = 10 run 0..T
END
# (a - 2)^5 = 0 within its error, and a point of two unknowns, which no family is
for force in '(a - 2)^5' '(a - 2)^2 + 3*(b - 3)^2' '(a - b)^2'; do
    printf 'param a, b\ncoord x\nparticle p mass 1 at x\nforce %s on x\nstart x = 0\nset b = 3\n' "$force" >force.lag
    case $force in *b*)
        ask force.lag -e "find a = 1.7, b = 2.8 such that value(x, 1) = 0 run 0..1"
        ask force.lag -e "find a = 2, b = 3 such that value(x, 1) = 0 run 0..1" ;;
    *)
        ask force.lag -e "find a = 1.7 such that value(x, 1) = 0 run 0..1" \
            -e "check value(a, 0) == 2 within 0.01" ;;
    esac
done
