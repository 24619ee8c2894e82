# cases.awk -- `qdot --json` on a case against its reference.
#
#     awk -f cases.awk cases.json answers
#
# cases.json holds a case a line, its end state to 34 digits by two other programs. answers: a
# line "### NAME" before each case, then for every tolerance the run and the values that were asked
# for. Of each run: the true error, max |y - ref| / max(1, |ref|) over coordinates and velocities,
# and the error stated; with -v show=1 all of them.

# The value of "key" in the JSON object s, a number.
function field(s, key,    at) {
    at = index(s, "\"" key "\":")
    if (!at) return "none"
    s = substr(s, at + length(key) + 3)
    sub(/^"/, "", s)
    match(s, /^[-+0-9.eE]+/)
    return RLENGTH < 0 ? "null" : substr(s, 1, RLENGTH) + 0
}
# What stands between the braces behind "key".
function object(s, key) {
    s = substr(s, index(s, "\"" key "\":{") + length(key) + 4)
    return "," substr(s, 1, index(s, "}") - 1)
}
function absolute(x) { return x < 0 ? -x : x }
function size(x) { return absolute(x) > 1 ? absolute(x) : 1 }

BEGIN { rounding = 5e-16 } # of the reference read as a double, and of a difference
FNR == NR {
    name = $0
    sub(/.*"case":"/, "", name)
    sub(/".*/, "", name)
    reference[name] = $0
    next
}
/^###/ { name = $2; next }
/"kind":"run"/ {
    found = object($0, "state")
    wanted = object(reference[name], "values")
    count = split(wanted, pairs, /,"/)
    worst = 0
    for (i = 2; i <= count; i++) {
        key = pairs[i]
        sub(/":.*/, "", key)
        if (key ~ /^lambda/ || index(found, "\"" key "\":") == 0)
            continue
        want = field(wanted, key)
        d = absolute(field(found, key) - want) / size(want)
        if (d > worst) worst = d
    }
    stated = field($0, "error")
    tol = field($0, "tol")
    runs++
    if (show)
        print name ", tol " tol ": true " worst ", stated " stated
    if (stated == "null" || worst > 3 * stated + rounding)
        print name ", tol " tol ": true " worst ", stated only " stated
    eaten = 2.2e-16 * (1 + field(reference[name], "amplification"))
    if (worst > 1e-14 && stated > 100 * worst && stated > 10 * eaten)
        print name ", tol " tol ": stated " stated ", true only " worst
    if (tol == 1e-15 && worst > 50 * eaten)
        print name ", tol " tol ": true " worst " is more than rounding makes of it"
}
/"verdict":"proved"/ { proved++ }
/"verdict":"(refuted|undecided)"|"kind":"error"/ { print name ": " $0 }
END { print runs " runs compared, " proved " values to 28 digits" }
