# end-errors.awk -- runs of `qdot --json` against the first one after each line "### NAME".
#
# Of each run: the true error, max |y - ref| / max(1, |ref|) over coordinates and velocities (and
# the time, of one that an event stopped), and the error stated.

function number(s) { gsub(/"/, "", s); return s + 0 }
function absolute(x) { return x < 0 ? -x : x }
function size(x) { return absolute(x) > 1 ? absolute(x) : 1 }
function field(s, key) {
    s = substr(s, index(s, "\"" key "\":") + length(key) + 3)
    match(s, /^"?[-+0-9.eE]+/)
    return RLENGTH < 0 ? "null" : number(substr(s, 1, RLENGTH))
}

BEGIN { rounding = 4e-16 } # of the reference read as a double, and of a difference
/^###/ { name = $2; first = 1; next }
/"kind":"error"/ { print name ": " $0 }
/"kind":"run"/ {
    state = substr($0, index($0, "\"state\":{") + 9)
    state = substr(state, 1, index(state, "}") - 1)
    match($0, /"t":\[[^]]*\]/)
    split(substr($0, RSTART + 5, RLENGTH - 6), t, ",")
    count = split(state, pairs, ",")
    pairs[count + 1] = "\"time\":" t[2]
    worst = 0
    for (i = 1; i <= count + 1; i++) {
        split(pairs[i], pair, "\":")
        if (pair[1] ~ /lambda/)
            continue
        if (first) {
            want[pair[1]] = number(pair[2])
            continue
        }
        d = absolute(number(pair[2]) - want[pair[1]]) / size(want[pair[1]])
        if (d > worst) worst = d
    }
    if (first) {
        first = 0
        next
    }
    runs++
    match($0, /"method":"[^"]*"/)
    what = name ", " substr($0, RSTART + 10, RLENGTH - 11) ", tol " field($0, "tol")
    stated = field($0, "error")
    if (show)
        print what ": true " worst ", stated " stated
    if (stated == "null" || worst > 3 * stated + rounding)
        print what ": true " worst ", stated only " stated
    if (worst > 1e-14 && stated > 100 * worst)
        overstated[++many] = what ": stated " stated ", true only " worst
}
END {
    # by luck, rounding adds up to nearly nothing in a few: not the same ones on every machine
    for (i = 1; many > runs / 100 && i <= many; i++)
        print overstated[i]
    print runs " runs compared"
}
