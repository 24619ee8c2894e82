# table.awk -- from points `who scene tol seconds cold whole error` of several rounds to two
# tables: the time to an end error, and the smallest error anyone reached.

function median(list,    part, n, i, j, x) {
    n = split(list, part, " ")
    for (i = 2; i <= n; i++) {
        x = part[i] + 0
        for (j = i - 1; j >= 1 && part[j] + 0 > x; j--)
            part[j + 1] = part[j]
        part[j + 1] = x
    }
    return n % 2 ? part[(n + 1) / 2] + 0 : (part[n / 2] + part[n / 2 + 1]) / 2
}

# Seconds of column `times` by which `who` reaches the error in the scene; "" if never.
function reach(times, who, scene, error,    i, n, a, b, ea, eb, x, best, key) {
    n = rungs[who, scene]
    best = ""
    for (i = 1; i <= n; i++) {
        key = who SUBSEP scene SUBSEP tols[who, scene, i]
        if (bad[key])
            continue
        b = median(times == "whole" ? whole[key] : times == "cold" ? cold[key] : spent[key])
        eb = errors[key]
        if (eb <= error && (best == "" || b < best))
            best = b
        if (i > 1 && a != "" && ea > error && eb <= error && eb > 0) {
            x = exp(log(a) + log(b / a) * log(ea / error) / log(ea / eb))
            if (best == "" || x < best)
                best = x
        }
        a = b
        ea = eb
    }
    return best
}

function smallest(who, scene,    i, n, key, best) {
    n = rungs[who, scene]
    best = ""
    for (i = 1; i <= n; i++) {
        key = who SUBSEP scene SUBSEP tols[who, scene, i]
        if (!bad[key] && (key in errors) && (best == "" || errors[key] < best))
            best = errors[key]
    }
    return best
}

function ms(x) {
    return x == "" ? "-" : sprintf("%.3g", 1000 * x)
}

function over(x, y) {
    return x == "" || y == "" ? "-" : sprintf("%.2f", x / y)
}

function least(list, scene, error,    part, n, i, x, best) {
    best = ""
    n = split(list, part, " ")
    for (i = 1; i <= n; i++) {
        x = reach("cpu", part[i], scene, error)
        if (x != "" && (best == "" || x < best))
            best = x
    }
    return best
}

{
    key = $1 SUBSEP $2 SUBSEP $3
    if (!(key in seen)) {
        seen[key] = 1
        tols[$1, $2, ++rungs[$1, $2]] = $3
    }
    if ($4 == "failed") {
        bad[key] = 1
        next
    }
    spent[key] = spent[key] " " $4
    cold[key] = cold[key] " " $5
    whole[key] = whole[key] " " $6
    if (!(key in errors) || $7 + 0 > errors[key])
        errors[key] = $7 + 0
}

END {
    hand = "rk8pd dop853 rkf78 adams fehlberg"
    linear = "rk8pd_linear dop853_linear rkf78_linear adams_linear fehlberg_linear"
    columns = split("rk8pd dop853 rkf78 adams fehlberg scipy", column, " ")

    print "# milliseconds to an end error, cold: in a fresh process; qdot's integration over"
    print "# that of the fastest by hand, of rk8pd, and (chains) of the fastest by hand in the"
    print "# O(N) form; whole/: the whole process of qdot over the integration alone of the"
    print "# fastest, where that is above 50 ms"
    printf "%-15s %-6s %8s %8s %8s", "# scene", "error", "qdot", "cold", "whole"
    for (c = 1; c <= columns; c++)
        printf " %8s", column[c]
    printf " %9s %8s %8s %8s\n", "/fastest", "/rk8pd", "/O(N)", "whole/"
    count = split(scenes, scene, " ")
    for (k = 1; k <= count; k++)
        for (power = 3; power <= 12; power += 3) {
            s = scene[k]
            error = 10^-power
            us = reach("cpu", "qdot", s, error)
            printf "%-15s 1e-%-3d %8s %8s %8s", s, power, ms(us),
                ms(reach("cold", "qdot", s, error)), ms(reach("whole", "qdot", s, error))
            for (c = 1; c <= columns; c++)
                printf " %8s", ms(reach("cpu", column[c], s, error))
            x = least(hand, s, error)
            printf " %9s %8s %8s %8s\n", over(us, x),
                over(us, reach("cpu", "rk8pd", s, error)),
                over(us, least(linear, s, error)),
                (x + 0 > 0.05 ? over(reach("whole", "qdot", s, error), x) : "-")
        }

    print ""
    print "# the smallest end error reached"
    printf "%-15s %8s", "# scene", "qdot"
    for (c = 1; c <= columns; c++)
        printf " %8s", column[c]
    printf " %8s\n", "O(N)"
    for (k = 1; k <= count; k++) {
        s = scene[k]
        printf "%-15s", s
        x = smallest("qdot", s)
        printf " %8s", x == "" ? "-" : sprintf("%.1e", x)
        for (c = 1; c <= columns; c++) {
            x = smallest(column[c], s)
            printf " %8s", x == "" ? "-" : sprintf("%.1e", x)
        }
        best = ""
        n = split(linear, part, " ")
        for (c = 1; c <= n; c++) {
            x = smallest(part[c], s)
            if (x != "" && (best == "" || x < best))
                best = x
        }
        printf " %8s\n", best == "" ? "-" : sprintf("%.1e", best)
    }
}
