# Formulas to .tex are LaTeX, to .html MathML, whatever the style; other endings say what to take.
cat >scene.lag <<'END'
param m, L, g > 0
coord theta
particle bob mass m at (L*sin(theta), -L*cos(theta))
gravity (0, -g)
END
qdot -q scene.lag - <<'END'
T to "T.tex"
eom to "eom.tex"
eom to "eom.html"
derive to "derive.tex"
latex(eom) to "latex.tex"
print "Here T is", T to "print.tex"
export latex mass_matrix to "M.tex"
style mathml
V to "V.tex"
T to "T.txt"
style plain
V
END
for file in T.tex eom.tex eom.html derive.tex latex.tex print.tex M.tex V.tex T.txt; do
    echo "--- $file"
    sed '/^<script>/,/^<\/script>/d' $file
done
for file in x.svg x.pdf x.csv x.h5 x x.doc; do
    qdot -q -e "coord x; x^2 to \"$file\""
done
