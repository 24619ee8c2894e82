/* span-kinks.c -- replaces what has kinks or steps by what it is in a range in which it has none inside. */
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/span.h"

/* floor(u) in the piece, inside which u is no integer: that of its value in the middle; nil if that is no number. */
static qdot_expr
floor_inside(qdot_span *r, qdot_expr u)
{
    qdot_pool *pool = r->pool;
    qdot_expr middle = qdot_mul(pool, QDOT_HALF, qdot_add(pool, r->lo, r->hi)), value = qdot_subs(pool, u, 1, &r->x, &middle), whole;
    double near;

    if (qdot_infinite(pool, r->lo) != 0 || qdot_infinite(pool, r->hi) != 0 || value == QDOT_NIL ||
        !qdot_expr_is_constant(pool, value))
        return QDOT_NIL;
    whole = qdot_fun1(pool, QDOT_FLOOR, value);
    if (whole == QDOT_NIL || qdot_expr_rational(pool, whole) != NULL)
        return whole;
    if (qdot_constant_double(pool, value, &near) != QDOT_OK || !(fabs(near) < 1e9) || fabs(near - round(near)) < 1e-6)
        return QDOT_NIL; /* too near to an integer to be told from it by a double */
    return qdot_expr_int(pool, (int64_t)floor(near));
}

/* The largest (or least) of the arguments of max (or min) in the piece, in which their order is the same everywhere. */
static qdot_expr
extreme_inside(qdot_span *r, qdot_expr node, bool max)
{
    qdot_pool *pool = r->pool;
    qdot_expr best = qdot_expr_arg(pool, node, 0);

    for (uint32_t i = 1; i < qdot_expr_count(pool, node); i++) {
        const qdot_expr other = qdot_expr_arg(pool, node, i);
        const int sign = qdot_span_sign(r, qdot_sub(pool, other, best));

        if (sign == 0)
            return node;
        best = (sign > 0) == max ? other : best;
    }
    return best;
}

/* Replace abs, sign, max, min, floor, mod and if by what they are in the piece: by their values at a point of it. */
static qdot_expr
without_kinks(qdot_pool *pool, qdot_expr node, void *user)
{
    qdot_span *r = user;
    qdot_fun_id id = (qdot_fun_id)qdot_expr_node(pool, node)->op;
    qdot_expr u = qdot_expr_arg(pool, node, 0), gap, modulus;
    int sign;

    if (!qdot_expr_contains(pool, node, r->x))
        return node;
    if (id == QDOT_MAX || id == QDOT_MIN)
        return extreme_inside(r, node, id == QDOT_MAX);
    if (id == QDOT_FLOOR || id == QDOT_MOD) {
        modulus = id == QDOT_MOD ? qdot_expr_arg(pool, node, 1) : QDOT_ONE;
        gap = qdot_expr_contains(pool, modulus, r->x) ? QDOT_NIL : floor_inside(r, qdot_div(pool, u, modulus));
        return gap == QDOT_NIL ? node : id == QDOT_FLOOR ? gap : qdot_sub(pool, u, qdot_mul(pool, modulus, gap));
    }
    if ((id != QDOT_ABS && id != QDOT_SIGN && id != QDOT_IF) ||
        (id == QDOT_IF && (qdot_expr_kind(pool, u) != QDOT_REL || !qdot_expr_contains(pool, u, r->x))))
        return node;
    gap = id == QDOT_IF ? qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0)) : u;
    sign = qdot_span_sign(r, gap);
    if (sign == 0)
        return node;
    switch (id) {
    case QDOT_ABS: return sign > 0 ? u : qdot_neg(pool, u);
    case QDOT_SIGN: return sign > 0 ? QDOT_ONE : QDOT_MINUS_ONE;
    default: return qdot_expr_arg(pool, node, sign > 0 ? 1 : 2);
    }
}

qdot_expr
qdot_span_without_kinks(qdot_span *r, qdot_expr e)
{
    return qdot_walk_replace(r->pool, e, QDOT_FUN, without_kinks, r);
}
