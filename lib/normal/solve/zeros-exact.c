/* zeros-exact.c -- guesses exact values of zeros, and tests them exactly. */
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "normal/prove/decide.h"
#include "normal/solve/zeros-parts.h"

enum { FRACTION = 100000, PART = 120 };

/* Find the fraction p/q with the smallest denominator in lo ... hi; false if no denominator is below `most`. */
static bool
find_simplest_fraction(double lo, double hi, int64_t most, int64_t *p, int64_t *q)
{
    int64_t a = 0, b = 1, c = 1,
         d = 0; /* a/b < x < c/d, neighbours in the tree of fractions (Stern-Brocot) */
    bool minus = hi < 0;

    *p = 0, *q = 1;
    if (!(lo <= hi) || fabs(lo) > 1e9 || fabs(hi) > 1e9)
        return false;
    if (lo <= 0 && hi >= 0)
        return true;
    if (minus) {
        double was = lo;

        lo = -hi;
        hi = -was;
    }
    a = (int64_t)floor(lo);
    c = a + 1, d = 1;
    if (a >= lo)
        c = a;
    if (c <= hi) { /* the next integer c lies in the interval */
        *p = minus ? -c : c;
        return true;
    }
    while (b + d <= most) {
        double middle = (double)(a + c) / (double)(b + d);

        if (middle < lo) {
            int64_t n = (int64_t)fmin((double)most, ((double)b * lo - (double)a) /
                                                  ((double)c - (double)d * lo));

            n = n < 1 ? 1 : n;
            a += n * c, b += n * d;
        } else if (middle > hi) {
            int64_t n = (int64_t)fmin((double)most, ((double)c - (double)d * hi) /
                                                  ((double)b * hi - (double)a));

            n = n < 1 ? 1 : n;
            c += n * a, d += n * b;
        } else {
            *p = minus ? -(a + c) : a + c;
            *q = b + d;
            return true;
        }
    }
    return false;
}

qdot_expr
qdot_zeros_candidate(qdot_pool *pool, qdot_interval X, int k)
{
    double unit = k == 0 ? 1 : M_PI;
    int64_t p, q;

    if (k > 1 || !find_simplest_fraction(X.lo / unit, X.hi / unit, k == 0 ? FRACTION : PART, &p, &q) ||
        (k == 1 && p == 0))
        return QDOT_NIL;
    return qdot_mul(pool, qdot_expr_ratio(pool, p, q), k == 0 ? QDOT_ONE : QDOT_PI);
}

qdot_status
qdot_zeros_vanish(qdot_pool *pool, size_t m, const qdot_expr *f, size_t n,
                  const qdot_expr *x, const qdot_expr *value, bool *yes)
{
    *yes = true;
    for (size_t i = 0; i < m && *yes; i++) {
        qdot_expr at = qdot_subs(pool, f[i], n, x, value);
        qdot_status status = qdot_pool_check(pool);

        if (status == QDOT_EDOMAIN) /* the equation is not defined at this exact value */
            *yes = false;
        else
            QDOT_TRY(status);
        if (*yes && at != QDOT_ZERO)
            *yes = qdot_is_zero(pool, at, NULL);
        QDOT_TRY(qdot_pool_check(pool));
    }
    return QDOT_OK;
}
