# six.awk -- every number rounded to six decimals, without zeros at its end: rounded and not cut off, because a value may be
# 0.9999999999998 on one machine and 1 on another; what is below 1e-9 is 0, which it may be exactly.
{
    gsub(/-?[0-9.]+e-(09|[1-9][0-9]+)/, "0")
    done = ""
    while (match($0, /[0-9]+\.[0-9][0-9][0-9][0-9][0-9][0-9][0-9]+/)) {
        before = substr($0, 1, RSTART - 1)
        number = sprintf("%.6f", substr($0, RSTART, RLENGTH))
        sub(/0+$/, "", number)
        sub(/\.$/, "", number)
        if (number == "0")
            sub(/-$/, "", before)
        done = done before number
        $0 = substr($0, RSTART + RLENGTH)
    }
    print done $0
}
