/* simple.c -- what is as simple as it can be, seen at a glance. */
#include "normal/simplify.h"

/* a + b + c, parameters. */
static bool
is_plain_sum(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);

    if (qdot_expr_kind(pool, e) != QDOT_SUM || qdot_expr_arg(pool, e, 0) != QDOT_ZERO)
        return false;
    for (uint32_t i = 1; i < n; i += 2)
        if (!qdot_expr_is_class(pool, qdot_expr_arg(pool, e, i), QDOT_PARAM) ||
            qdot_expr_arg(pool, e, i + 1) != QDOT_ONE)
            return false;
    return true;
}

/* f(x), x a symbol. */
static bool
is_plain_function(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    return (kind == QDOT_FUN || kind == QDOT_UFUN) && qdot_expr_count(pool, e) <= 2 &&
           qdot_expr_kind(pool, qdot_expr_arg(pool, e, 0)) == QDOT_SYM;
}

/* Powers of symbols; with positive ones also one function and one sum: nothing cancels. */
static bool
is_simple_product(const qdot_pool *pool, qdot_expr e)
{
    int functions = 0, sums = 0;
    bool below = false;
    long k;

    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i);

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &k))
            return false;
        below |= k < 0;
        if (qdot_expr_kind(pool, b) == QDOT_SYM)
            continue;
        functions += is_plain_function(pool, b);
        sums += is_plain_sum(pool, b);
        if (k != 1 || (!is_plain_function(pool, b) && !is_plain_sum(pool, b)))
            return false;
    }
    return functions <= 1 && sums <= 1 && (functions + sums == 0 || !below);
}

bool
qdot_simplify_is_done(const qdot_pool *pool, qdot_expr e)
{
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM:
    case QDOT_SYM: return true;
    case QDOT_FUN:
    case QDOT_UFUN: return is_plain_function(pool, e);
    case QDOT_PROD: return is_simple_product(pool, e);
    default: return is_plain_sum(pool, e);
    }
}
