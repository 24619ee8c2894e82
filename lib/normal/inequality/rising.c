/* rising.c -- takes functions that rise away from the sides of an inequality. */
#include "normal/inequality/rising.h"

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"

static bool
has_positive_sign(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_sign(pool, e) & QDOT_POS) == QDOT_POS;
}

/* The only factor of e that is not known to be positive, of power 1; e itself if there is no such factor. */
static qdot_expr
unsigned_factor(const qdot_pool *pool, qdot_expr e)
{
    qdot_expr left = QDOT_NIL;

    if (qdot_expr_kind(pool, e) != QDOT_PROD || !has_positive_sign(pool, qdot_expr_arg(pool, e, 0)))
        return e;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i);

        if (has_positive_sign(pool, base))
            continue;
        if (left != QDOT_NIL || qdot_expr_arg(pool, e, i + 1) != QDOT_ONE)
            return e;
        left = base;
    }
    return left == QDOT_NIL ? e : left;
}

bool
qdot_has_square_root(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 2; qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2) {
        const fmpq *power = qdot_expr_rational(pool, qdot_expr_arg(pool, e, i));

        if (power != NULL && fmpz_equal_si(fmpq_denref(power), 2))
            return true;
    }
    return false;
}

/* u - c^2 for k sqrt(u) - k c with k > 0, c >= 0; nil: e is of another form. */
static qdot_expr
square_sides(qdot_pool *pool, qdot_expr e)
{
    qdot_expr c, k, root;

    if (qdot_expr_kind(pool, e) != QDOT_SUM || qdot_expr_count(pool, e) != 3)
        return QDOT_NIL;
    root = qdot_expr_arg(pool, e, 1);
    k = qdot_expr_arg(pool, e, 2);
    if (!has_positive_sign(pool, k) || !(qdot_expr_sign(pool, root) & QDOT_GE0) || !qdot_has_square_root(pool, root))
        return QDOT_NIL;
    c = qdot_div(pool, qdot_expr_arg(pool, e, 0), k);
    return c != QDOT_NIL && (qdot_expr_sign(pool, c) & QDOT_LE0) ? qdot_sub(pool, qdot_mul(pool, root, root), qdot_mul(pool, c, c))
                                                                 : QDOT_NIL;
}

qdot_expr
qdot_without_rising(qdot_pool *pool, qdot_expr e, bool strict)
{
    while (e != QDOT_NIL) {
        const qdot_expr f = unsigned_factor(pool, e), squared = square_sides(pool, e);

        if (squared != QDOT_NIL)
            e = squared;
        else if (qdot_expr_is_function_that(pool, f, QDOT_FUN_ODD) && qdot_expr_is_function_that(pool, f, QDOT_FUN_RISING))
            e = qdot_expr_arg(pool, f, 0);
        else if (qdot_expr_is_function(pool, f, QDOT_LOG) || (strict && qdot_expr_is_function(pool, f, QDOT_ACOSH)))
            e = qdot_sub(pool, qdot_expr_arg(pool, f, 0), QDOT_ONE);
        else
            break;
    }
    return e;
}
