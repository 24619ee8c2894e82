/* rewrite.c -- replaces functions by their definitions in terms of others, in one pass, children first. */
#include "normal/prove/rewrite.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"

static qdot_expr
half_of(qdot_pool *pool, qdot_expr e)
{
    return qdot_mul(pool, QDOT_HALF, e);
}

/* The inverse hyperbolic function (area function) log(v + sqrt(v^2 + c)). */
static qdot_expr
area_function(qdot_pool *pool, qdot_expr v, qdot_expr c)
{
    qdot_expr root = qdot_sqrt(pool, qdot_add(pool, qdot_pow_int(pool, v, 2), c));

    return qdot_fun1(pool, QDOT_LOG, qdot_add(pool, v, root));
}

static qdot_expr
area_tangent(qdot_pool *pool, qdot_expr v)
{
    qdot_expr up = qdot_add(pool, QDOT_ONE, v), down = qdot_sub(pool, QDOT_ONE, v);

    return half_of(pool, qdot_fun1(pool, QDOT_LOG, qdot_div(pool, up, down)));
}

qdot_expr
qdot_rewrite_extreme(qdot_pool *pool, qdot_expr e)
{
    bool most = qdot_expr_node(pool, e)->op == QDOT_MAX;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr best = qdot_expr_arg(pool, e, 0);

    for (uint32_t i = 1; i < n; i++) {
        qdot_expr y = qdot_expr_arg(pool, e, i);
        qdot_expr gap = qdot_fun1(pool, QDOT_ABS, qdot_sub(pool, best, y));

        best = half_of(pool, qdot_add(pool, qdot_add(pool, best, y),
                                      most ? gap : qdot_neg(pool, gap)));
    }
    return best;
}

/* Replace floor(x + k) by floor(x) + k for an integer k. */
static qdot_expr
rewrite_floor(qdot_pool *pool, qdot_expr x)
{
    qdot_expr k;

    x = qdot_expand(pool, x); /* expand, so that integers in sums are found, as in (c + 8)/4 */
    if (x == QDOT_NIL || qdot_expr_kind(pool, x) != QDOT_SUM)
        return qdot_fun1(pool, QDOT_FLOOR, x);
    k = qdot_fun1(pool, QDOT_FLOOR, qdot_expr_arg(pool, x, 0));
    return qdot_add(pool, k, qdot_fun1(pool, QDOT_FLOOR, qdot_sub(pool, x, k)));
}

/* Write mod(a, b) as a - b floor(a/b). */
static qdot_expr
rewrite_modulo(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr whole = rewrite_floor(pool, qdot_div(pool, a, b));

    return qdot_sub(pool, a, qdot_mul(pool, b, whole));
}

/* The power u^c for an argument c log(u) with a number c; nil for other arguments. */
static qdot_expr
power_from_logarithm(qdot_pool *pool, qdot_expr arg)
{
    qdot_expr c = QDOT_ONE;

    if (qdot_expr_kind(pool, arg) == QDOT_PROD && qdot_expr_count(pool, arg) == 3 &&
        qdot_expr_arg(pool, arg, 2) == QDOT_ONE) {
        c = qdot_expr_arg(pool, arg, 0);
        arg = qdot_expr_arg(pool, arg, 1);
    }
    if (qdot_expr_kind(pool, arg) != QDOT_FUN || qdot_expr_node(pool, arg)->op != QDOT_LOG)
        return QDOT_NIL;
    return qdot_pow(pool, qdot_expr_arg(pool, arg, 0), c);
}

/* Rewrite sinh, cosh, tanh of c log u, or of any argument, by exponentials: (w - 1/w)/2 ... with w = u^c. */
static qdot_expr
rewrite_hyperbolic(qdot_pool *pool, qdot_expr e, bool exponentials)
{
    qdot_expr arg = qdot_expr_arg(pool, e, 0), w = power_from_logarithm(pool, arg), over, s, c;

    if (w != QDOT_NIL)
        ;
    else if (exponentials)
        w = qdot_fun1(pool, QDOT_EXP, arg);
    else
        return e;
    over = qdot_div(pool, QDOT_ONE, w);
    s = qdot_sub(pool, w, over);
    c = qdot_add(pool, w, over);
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_SINH: return half_of(pool, s);
    case QDOT_COSH: return half_of(pool, c);
    default: return qdot_div(pool, s, c);
    }
}

static qdot_expr
rewrite_function(qdot_pool *pool, qdot_expr e, bool exponentials)
{
    qdot_expr v = qdot_expr_arg(pool, e, 0);

    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_ACOS:
        return qdot_sub(pool, half_of(pool, QDOT_PI), qdot_fun1(pool, QDOT_ASIN, v));
    case QDOT_ASINH: return area_function(pool, v, QDOT_ONE);
    case QDOT_ACOSH: return area_function(pool, v, QDOT_MINUS_ONE);
    case QDOT_ATANH: return area_tangent(pool, v);
    case QDOT_ERFC: return qdot_sub(pool, QDOT_ONE, qdot_fun1(pool, QDOT_ERF, v));
    case QDOT_MAX:
    case QDOT_MIN: return qdot_rewrite_extreme(pool, e);
    case QDOT_MOD: return rewrite_modulo(pool, v, qdot_expr_arg(pool, e, 1));
    case QDOT_FLOOR: return rewrite_floor(pool, v);
    case QDOT_SINH:
    case QDOT_COSH:
    case QDOT_TANH: return rewrite_hyperbolic(pool, e, exponentials);
    default: return e;
    }
}

static qdot_expr
rewrite_product(qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr result = qdot_expr_arg(pool, e, 0);
    bool any = false;

    for (uint32_t i = 2; i < n && !any; i += 2)
        any = qdot_expr_kind(pool, qdot_expr_arg(pool, e, i)) != QDOT_NUM;
    if (!any)
        return e;
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1), power;

        if (qdot_expr_kind(pool, x) != QDOT_NUM &&
            (qdot_expr_node(pool, b)->sign & QDOT_POS) == QDOT_POS)
            power = qdot_fun1(pool, QDOT_EXP,
                              qdot_mul(pool, x, qdot_fun1(pool, QDOT_LOG, b)));
        else
            power = qdot_pow(pool, b, x);
        result = qdot_mul(pool, result, power);
    }
    return result;
}

qdot_expr
qdot_rewrite(qdot_pool *pool, qdot_expr e, bool exponentials)
{
    qdot_expr result = e;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && result != QDOT_NIL; i++) {
        result = qdot_walk_rebuild(pool, &w, w.at[i]);
        if (result != QDOT_NIL && qdot_expr_kind(pool, result) == QDOT_FUN)
            result = rewrite_function(pool, result, exponentials);
        else if (result != QDOT_NIL && qdot_expr_kind(pool, result) == QDOT_PROD)
            result = rewrite_product(pool, result);
        qdot_walk_set(&w, w.at[i], result);
    }
    qdot_walk_end(&w);
    return result;
}

bool
qdot_rewrite_has_exp(const qdot_pool *pool, qdot_expr e)
{
    bool found = false;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !found; i++) {
        qdot_kind kind = qdot_expr_kind(pool, w.at[i]);

        found = kind == QDOT_FUN && qdot_expr_node(pool, w.at[i])->op == QDOT_EXP;
        for (uint32_t k = 2;
             kind == QDOT_PROD && !found && k < qdot_expr_count(pool, w.at[i]); k += 2)
            found = qdot_expr_kind(pool, qdot_expr_arg(pool, w.at[i], k)) != QDOT_NUM;
    }
    qdot_walk_end(&w);
    return found;
}
