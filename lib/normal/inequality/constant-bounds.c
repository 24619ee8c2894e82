/* constant-bounds.c -- doubles and rational numbers just beside constants. */
#include "normal/inequality/constant-bounds.h"

#include <math.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/refute/ball.h"

qdot_expr
qdot_constant_terms(qdot_pool *pool, qdot_expr e)
{
    const uint32_t n = qdot_expr_kind(pool, e) == QDOT_SUM ? qdot_expr_count(pool, e) : 0;
    qdot_expr all = n == 0 ? QDOT_ZERO : qdot_expr_arg(pool, e, 0);

    for (uint32_t i = 1; i + 1 < n; i += 2)
        if (qdot_expr_is_constant(pool, qdot_expr_arg(pool, e, i)))
            all = qdot_add(pool, all, qdot_mul(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1)));
    return all;
}

qdot_expr
qdot_with_less_constants(qdot_pool *pool, qdot_expr d, bool coarse)
{
    const qdot_expr constant = qdot_constant_terms(pool, d);
    double below;

    if (qdot_expr_rational(pool, constant) != NULL)
        return QDOT_NIL;
    below = qdot_ball_bounds(pool, constant).lo;
    if (!isfinite(below))
        return QDOT_NIL;
    if (coarse)
        below = ldexp(floor(ldexp(below, 20)), -20);
    return qdot_add(pool, qdot_sub(pool, d, constant), qdot_expr_of_double(pool, below));
}

bool
qdot_holds_constant_function(qdot_pool *pool, qdot_expr e)
{
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return true;
    }
    for (size_t i = 0; i < w.n && !found; i++)
        found = qdot_expr_kind(pool, w.at[i]) == QDOT_FUN && qdot_expr_is_constant(pool, w.at[i]);
    qdot_walk_end(&w);
    return found;
}

qdot_expr
qdot_weaker_condition(qdot_pool *pool, qdot_expr c)
{
    qdot_expr weaker = c;

    if (qdot_expr_kind(pool, c) == QDOT_REL && qdot_expr_node(pool, c)->op != QDOT_EQ) {
        const qdot_expr less =
            qdot_with_less_constants(pool, qdot_sub(pool, qdot_expr_arg(pool, c, 0), qdot_expr_arg(pool, c, 1)), true);

        if (less != QDOT_NIL)
            weaker = qdot_rel(pool, qdot_expr_node(pool, c)->op, less, QDOT_ZERO);
    }
    return weaker == QDOT_NIL || qdot_holds_constant_function(pool, weaker) ? QDOT_NIL : weaker;
}
