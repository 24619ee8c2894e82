# inner-times.awk -- values of runs beside those of a run named `exact`, which come first.
#
#     awk -f inner-times.awk answers
#
# Of each value: the true error is at most 3 times the stated one, but for 1 in 300, which rounding
# chooses, and never 10 times; nearly nowhere is the stated one more than 100 times the true one
# where that is above 1e-14.
function field(s, key) {
    s = substr(s, index(s, "\"" key "\":") + length(key) + 3)
    sub(/^"/, "", s)
    match(s, /^[-+0-9.eE]+/)
    return RLENGTH < 0 ? "null" : substr(s, 1, RLENGTH) + 0
}
function absolute(x) { return x < 0 ? -x : x }

BEGIN { rounding = 1.2e-16 } # of the reference read as a double
/^###/ { scene = $2; next }
/"kind":"error"/ { print scene ": " $0 }
/"name":"value\(exact\./ { want = field($0, "value"); next }
/"kind":"number"/ {
    d = absolute(field($0, "value") - want)
    stated = field($0, "error")
    count++
    least = rounding * absolute(want)
    if (stated == "null" || d > 10 * stated + least)
        print scene ": " $0 ", true error " d
    if (stated != "null" && d > 3 * stated + least)
        missed++
    if (d > 1e-14 && stated > 100 * d)
        generous++
}
END {
    if (missed > count / 300)
        print missed " values miss their errors"
    print count " values compared, " (generous > count / 200 ? generous : "few") " with generous errors"
}
