/* parts.c -- integrates by parts: int u v' = u v - int u' v, with u a logarithm, an inverse function, an error function. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"

/* Whether the derivative of the function is simpler than it. */
static bool
has_simpler_slope(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function_that(pool, e, QDOT_FUN_ARC) || qdot_expr_is_function_that(pool, e, QDOT_FUN_AREA) ||
           qdot_expr_is_function(pool, e, QDOT_LOG) || qdot_expr_is_function(pool, e, QDOT_ERF) ||
           qdot_expr_is_function(pool, e, QDOT_ERFC);
}

static qdot_expr
integrate_with(qdot_integral_task *t, qdot_expr u, qdot_expr dv, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr v = qdot_integral_any(t, dv, x, depth + 1), left;

    if (v == QDOT_NIL)
        return v;
    left = qdot_integral_normal(t, qdot_mul(pool, qdot_diff(pool, u, x), v));
    left = qdot_integral_any(t, left, x, depth + 1);
    return left == QDOT_NIL ? left : qdot_sub(pool, qdot_mul(pool, u, v), left);
}

qdot_expr
qdot_parts_integrate(qdot_integral_task *t, qdot_expr term, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    bool product = qdot_expr_kind(pool, term) == QDOT_PROD;
    uint32_t n = product ? qdot_expr_count(pool, term) : 3;

    for (uint32_t i = 1; i < n && !t->failed; i += 2) {
        qdot_expr base = product ? qdot_expr_arg(pool, term, i) : term, u;
        qdot_expr exponent = product ? qdot_expr_arg(pool, term, i + 1) : QDOT_ONE;
        int64_t k;

        if (!qdot_expr_contains(pool, base, x) || !has_simpler_slope(pool, base) ||
            !qdot_expr_to_int(pool, exponent, &k) || k < 1 || k > QDOT_INTEGRAL_DEPTH)
            continue;
        u = qdot_pow(pool, base, exponent);
        return integrate_with(t, u, qdot_div(pool, term, u), x, depth);
    }
    for (uint32_t i = 1; i < n && product && !t->failed && depth < 4; i += 2) { /* x^k lowers its power */
        int64_t k;

        if (qdot_expr_arg(pool, term, i) == x && qdot_expr_to_int(pool, qdot_expr_arg(pool, term, i + 1), &k) && k >= 1 &&
            k <= 3 && n > 3)
            return integrate_with(t, qdot_pow_int(pool, x, k), qdot_div(pool, term, qdot_pow_int(pool, x, k)), x, depth);
    }
    return QDOT_NIL;
}
