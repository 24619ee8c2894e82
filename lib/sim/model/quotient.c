/* quotient.c -- divides a force by a mass, cancelling common factors term by term. */
#include "sim/model/quotient.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"

/* The integer exponent of `base` as a factor of a term; 0 if it is no factor. */
static int64_t
exponent_of_factor(const qdot_pool *pool, qdot_expr term, qdot_expr base)
{
    int64_t n;

    if (term == base)
        return 1;
    if (qdot_expr_kind(pool, term) != QDOT_PROD)
        return 0;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, term); i += 2)
        if (qdot_expr_arg(pool, term, i) == base)
            return qdot_expr_to_int(pool, qdot_expr_arg(pool, term, i + 1), &n) ? n : 0;
    return 0;
}

/* f without base^n in front, n at most what M has of it and what all terms of f share;
 * *M without it too. */
static qdot_expr
cancel_common_factor(qdot_pool *pool, qdot_expr f, qdot_expr base, qdot_expr *M)
{
    int64_t shared = exponent_of_factor(pool, *M, base);
    qdot_expr sum = QDOT_ZERO, common;

    if (shared <= 0 || qdot_expr_arg(pool, f, 0) != QDOT_ZERO)
        return f;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, f) && shared > 0; i += 2) {
        int64_t n = exponent_of_factor(pool, qdot_expr_arg(pool, f, i), base);

        shared = n < shared ? n : shared;
    }
    if (shared <= 0)
        return f;
    common = qdot_pow_int(pool, base, shared);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, f); i += 2)
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, qdot_expr_arg(pool, f, i + 1),
                                qdot_div(pool, qdot_expr_arg(pool, f, i), common)));
    *M = qdot_div(pool, *M, common);
    return sum;
}

qdot_expr
qdot_quotient(qdot_pool *pool, qdot_expr f, qdot_expr M)
{
    const qdot_expr whole = M;

    if (qdot_pool_failed(pool) || qdot_expr_kind(pool, f) != QDOT_SUM)
        return qdot_div(pool, f, M);
    if (qdot_expr_kind(pool, whole) != QDOT_PROD) {
        f = cancel_common_factor(pool, f, whole, &M);
    } else {
        for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, whole); i += 2)
            if (!qdot_pool_failed(pool) && qdot_expr_kind(pool, f) == QDOT_SUM)
                f = cancel_common_factor(pool, f, qdot_expr_arg(pool, whole, i), &M);
    }
    return qdot_div(pool, f, M);
}
