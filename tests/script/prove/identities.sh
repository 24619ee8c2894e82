# Identities true and false from mechanics: every identities-*.inc, each check with its verdict.
# `check not` is of what is false; a line that begins with WRONG is what to look at.
for file in identities-*.inc; do
    echo "== $file"
    qdot -q "$file" >answers 2>&1
    grep -vE '^(proved|refuted|undecided)|^notice: `L`' answers
    grep -E '^(proved|refuted|undecided)' answers | sed 's/[: ].*//' >verdicts
    grep '^check' "$file" | paste -d ' ' verdicts - |
        sed -e 's/^proved check not/WRONG proved check not/' \
            -e '/^refuted check not/!s/^refuted/WRONG refuted/'
done
