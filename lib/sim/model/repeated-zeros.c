/* repeated-zeros.c -- finds smooth functions with the zeros of mod, floor, tan and atan2 minus a number. */
#include "sim/model/repeated-zeros.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/model/simple-zeros.h"

static bool
is_jumping_function(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function(pool, e, QDOT_MOD) || qdot_expr_is_function(pool, e, QDOT_FLOOR)
           || qdot_expr_is_function(pool, e, QDOT_TAN) || qdot_expr_is_function(pool, e, QDOT_ATAN2);
}

/* The outermost jumping function in e; nil if there is none. Whether e depends on it only, its
 * derivative tells. */
static qdot_status
find_outermost_jump(const qdot_pool *pool, qdot_expr e, qdot_expr *f)
{
    qdot_walk walk;
    qdot_status status = qdot_walk_begin(pool, e, &walk);

    *f = QDOT_NIL;
    /* arguments come before functions, so the last one found is the outermost */
    for (size_t i = 0; status == QDOT_OK && i < walk.n; i++)
        if (is_jumping_function(pool, walk.at[i]))
            *f = walk.at[i];
    qdot_walk_end(&walk);
    return status;
}

/* Write g = c f + k' with numbers c and k'; returns c and k = -k'/c. c is nil if g has no such form. */
static qdot_status
split_linear(qdot_pool *pool, qdot_expr g, qdot_expr f, qdot_expr *c, qdot_expr *k)
{
    /* the symbol's name has a space, which no user's name contains */
    const qdot_expr s = qdot_symbol_get(pool, QDOT_FORMAL, "jumping function");
    const qdot_expr with = qdot_subs(pool, g, 1, &f, &s), slope = qdot_diff(pool, with, s);
    qdot_expr rest;

    *c = *k = QDOT_NIL;
    QDOT_TRY(qdot_pool_check(pool));
    if (slope == QDOT_ZERO || !qdot_expr_is_constant(pool, slope))
        return QDOT_OK;
    rest = qdot_sub(pool, with, qdot_mul(pool, slope, s));
    QDOT_TRY(qdot_pool_check(pool));
    if (!qdot_expr_is_constant(pool, rest))
        return QDOT_OK;
    *c = slope;
    *k = qdot_neg(pool, qdot_div(pool, rest, slope));
    return qdot_pool_check(pool);
}

/* Set u = sin(phase); at even multiples of pi it passes 0 in the direction of g if `forward` > 0. */
static void
set_sine(qdot_pool *pool, qdot_expr phase, qdot_expr forward, qdot_repeated *out)
{
    out->u = qdot_fun1(pool, QDOT_SIN, phase);
    out->turn = out->touches ? QDOT_NIL : qdot_mul(pool, forward, qdot_fun1(pool, QDOT_COS, phase));
}

static qdot_status
find_zeros_of_mod(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_expr c, qdot_expr k, qdot_repeated *out)
{
    double part, period;

    if (!qdot_expr_is_constant(pool, b))
        return QDOT_OK;
    QDOT_TRY(qdot_constant_double(pool, b, &period));
    if (period == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_constant_double(pool, qdot_div(pool, k, b), &part));
    if (!(part >= 0 && part < 1)) { /* there are no zeros; for k = b, mod(a, b) comes arbitrarily near to k */
        out->u = QDOT_ONE;
        return QDOT_OK;
    }
    out->touches = part == 0;
    set_sine(pool, qdot_mul(pool, QDOT_PI, qdot_div(pool, qdot_sub(pool, a, k), b)), qdot_div(pool, c, b), out);
    return QDOT_OK;
}

static qdot_status
find_zeros_of_floor(qdot_pool *pool, qdot_expr a, qdot_expr c, qdot_expr k, qdot_repeated *out)
{
    const qdot_expr over = qdot_sub(pool, a, k);
    qdot_expr ends[] = {over, QDOT_ZERO}, beyond[] = {qdot_sub(pool, over, QDOT_ONE), QDOT_ZERO};
    double n;

    QDOT_TRY(qdot_constant_double(pool, k, &n));
    if (n != floor(n)) { /* floor(a) is never k */
        out->u = QDOT_ONE;
        return QDOT_OK;
    }
    out->u = qdot_mul(pool, c, qdot_add(pool, qdot_fun(pool, QDOT_MIN, 2, ends), qdot_fun(pool, QDOT_MAX, 2, beyond)));
    return QDOT_OK;
}

static qdot_status
find_zeros_of_angle(qdot_pool *pool, qdot_expr y, qdot_expr x, qdot_expr c, qdot_expr k, qdot_repeated *out)
{
    const qdot_expr sine = qdot_fun1(pool, QDOT_SIN, k), cosine = qdot_fun1(pool, QDOT_COS, k);
    double angle, forward;
    int side;

    QDOT_TRY(qdot_constant_double(pool, c, &forward));
    QDOT_TRY(qdot_constant_round(pool, qdot_sub(pool, k, QDOT_PI), &angle, &side));
    out->touches = angle == 0;
    if (angle > 0)
        out->u = QDOT_ONE;
    QDOT_TRY(qdot_constant_double(pool, qdot_add(pool, k, QDOT_PI), &angle));
    if (angle <= 0)
        out->u = QDOT_ONE;
    if (out->u == QDOT_ONE)
        return QDOT_OK;
    out->u = qdot_sub(pool, qdot_mul(pool, y, cosine), qdot_mul(pool, x, sine));
    if (forward < 0)
        out->u = qdot_neg(pool, out->u);
    out->turn = qdot_add(pool, qdot_mul(pool, x, cosine), qdot_mul(pool, y, sine));
    out->half = true;
    return QDOT_OK;
}

qdot_status
qdot_repeated_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out)
{
    qdot_expr f, c, k, a;

    *out = (qdot_repeated){.u = g, .turn = QDOT_NIL};
    if (g == QDOT_NIL || (qdot_expr_node(pool, g)->holds & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)) != 0)
        return QDOT_OK; /* give up: the direction `turn` must depend on the state only */
    QDOT_TRY(find_outermost_jump(pool, g, &f));
    if (f == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(split_linear(pool, g, f, &c, &k));
    if (c == QDOT_NIL)
        return QDOT_OK;
    a = qdot_expr_arg(pool, f, 0);
    if (qdot_expr_is_function(pool, f, QDOT_TAN))
        set_sine(pool, qdot_sub(pool, a, qdot_fun1(pool, QDOT_ATAN, k)), c, out);
    else if (qdot_expr_is_function(pool, f, QDOT_MOD))
        QDOT_TRY(find_zeros_of_mod(pool, a, qdot_expr_arg(pool, f, 1), c, k, out));
    else if (qdot_expr_is_function(pool, f, QDOT_FLOOR))
        QDOT_TRY(find_zeros_of_floor(pool, a, c, k, out));
    else
        QDOT_TRY(find_zeros_of_angle(pool, a, qdot_expr_arg(pool, f, 1), c, k, out));
    return qdot_pool_check(pool);
}

qdot_status
qdot_watched_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out)
{
    const qdot_expr v = qdot_touching_zeros(pool, g);

    QDOT_TRY(qdot_repeated_zeros(pool, qdot_simple_zeros(pool, v != QDOT_NIL ? v : g), out));
    out->touches = out->touches || v != QDOT_NIL;
    return qdot_pool_check(pool);
}
