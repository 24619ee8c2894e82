# compare.awk EXPECTED SEEN -- are two outputs the same but for what rounding leaves? Status 0 if so.
#
# Processors differ in the order of Taylor series and in fused operations, so the last digits of a number of a run do.
# Lines are the same if they are equal apart from runs of blanks and from numbers written with nine or more
# significant digits, which may differ by 1e-9 of the larger of 1 and themselves; TINY is 0. That a number is
# right to its stated error is for `check ... within` to say.
function digits(number)
{
    sub(/e.*/, "", number)
    gsub(/[-.]/, "", number)
    sub(/^0+/, "", number)
    return length(number)
}

# The next number of the text `rest`, with what stands before it in `before`; "" where there is none.
function take(    number)
{
    if (!match(rest, /-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?/)) {
        before = rest
        rest = ""
        return ""
    }
    before = substr(rest, 1, RSTART - 1)
    number = substr(rest, RSTART, RLENGTH)
    rest = substr(rest, RSTART + RLENGTH)
    return number
}

function same(a, b,    x, y, text, size)
{
    gsub(/  +/, " ", a)
    gsub(/  +/, " ", b)
    gsub(/TINY/, "0", a)
    gsub(/TINY/, "0", b)
    while (a != b) {
        rest = a
        x = take()
        a = rest
        text = before
        rest = b
        y = take()
        b = rest
        if (text != before || x == "" || y == "")
            return 0
        if (x == y)
            continue
        if (digits(x) < 9 && digits(y) < 9)
            return 0
        size = x < 0 ? -x : x + 0
        if (size < 1)
            size = 1
        if (x - y > 1e-9 * size || y - x > 1e-9 * size)
            return 0
    }
    return 1
}

BEGIN {
    while (1) {
        more = (getline line < ARGV[1]) > 0
        if (((getline other < ARGV[2]) > 0) != more)
            exit 1
        if (!more)
            exit 0
        if (line != other && !same(line, other))
            exit 1
    }
}
