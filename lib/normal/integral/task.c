/* task.c -- signs, logarithms, roots and new variables for integration. */
#include "normal/integral/task.h"

#include <stdio.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"

bool
qdot_integral_goes(qdot_integral_task *t)
{
    if (t->effort > 0)
        t->effort--;
    return t->effort > 0 && !t->failed && !qdot_pool_failed(t->pool);
}

qdot_expr
qdot_integral_normal(qdot_integral_task *t, qdot_expr e)
{
    if (e == QDOT_NIL || qdot_expr_kind(t->pool, e) == QDOT_NUM || qdot_expr_kind(t->pool, e) == QDOT_SYM)
        return e;
    return qdot_normal(t->pool, e, NULL);
}

bool
qdot_integral_zero(qdot_integral_task *t, qdot_expr e)
{
    uint32_t holds;

    e = qdot_integral_normal(t, e);
    if (e == QDOT_NIL || e == QDOT_ZERO)
        return true;
    holds = qdot_expr_node(t->pool, e)->holds;
    if (qdot_expr_kind(t->pool, e) == QDOT_NUM || (qdot_expr_sign(t->pool, e) & QDOT_NE0))
        return false;
    if (qdot_expr_is_constant(t->pool, e) || (holds & QDOT_HAS_FUN))
        return qdot_is_zero(t->pool, e, t->facts);
    return false;
}

qdot_expr
qdot_integral_variable(qdot_integral_task *t, bool positive)
{
    char name[16];
    qdot_expr w;

    snprintf(name, sizeof name, positive ? "w+%u" : "w#%u", t->fresh++);
    w = qdot_symbol_get(t->pool, QDOT_FORMAL, name);
    if (positive && w != QDOT_NIL && qdot_expr_symbol(t->pool, w)->lo == QDOT_NIL)
        qdot_symbol_domain(t->pool, w, QDOT_ZERO, true, QDOT_NIL, false);
    return w;
}

static int
known_sign(qdot_integral_task *t, qdot_expr e)
{
    uint8_t sign = qdot_expr_sign(t->pool, e);
    double value;

    if ((sign & QDOT_POS) == QDOT_POS)
        return 1;
    if ((sign & QDOT_NEG) == QDOT_NEG)
        return -1;
    if (qdot_expr_is_constant(t->pool, e)) {
        if (qdot_constant_double(t->pool, e, &value) == QDOT_OK)
            return (value > 0) - (value < 0);
        t->failed = true;
    }
    return 0;
}

int
qdot_integral_sign(qdot_integral_task *t, qdot_expr e)
{
    qdot_expr condition, opposite;
    int known;

    e = qdot_integral_normal(t, e);
    if (e == QDOT_NIL || qdot_integral_zero(t, e))
        return 0;
    known = known_sign(t, e);
    if (known != 0 || t->failed)
        return known;
    condition = qdot_positive(t->pool, e, t->facts, 0, NULL);
    opposite = qdot_positive(t->pool, qdot_neg(t->pool, e), t->facts, 0, NULL);
    if (condition == QDOT_TRUE || opposite == QDOT_FALSE)
        return 1;
    if (condition == QDOT_FALSE || opposite == QDOT_TRUE)
        return -1;
    for (size_t i = 0; i < t->asked; i++)
        if (t->condition[i] == condition || t->condition[i] == opposite)
            return (t->condition[i] == condition) == t->holds[i] ? 1 : -1;
    if (condition == QDOT_NIL || !t->may_assume || t->asked == QDOT_INTEGRAL_SIGNS) {
        t->failed = true;
        return 0;
    }
    t->condition[t->asked] = condition;
    return t->holds[t->asked++] ? 1 : -1;
}

qdot_expr
qdot_integral_log(qdot_integral_task *t, qdot_expr u)
{
    qdot_pool *pool = t->pool;

    if (u == QDOT_NIL)
        return u;
    if ((qdot_expr_sign(pool, u) & QDOT_POS) != QDOT_POS &&
        qdot_positive(pool, u, t->facts, 0, NULL) != QDOT_TRUE)
        u = qdot_fun1(pool, QDOT_ABS, u);
    return qdot_fun1(pool, QDOT_LOG, u);
}

static qdot_expr
without_bars(qdot_pool *pool, qdot_expr node, void *user)
{
    (void)user;
    return qdot_expr_is_function(pool, node, QDOT_ABS) ? qdot_expr_arg(pool, node, 0) : node;
}

qdot_expr
qdot_integral_root(qdot_integral_task *t, qdot_expr v)
{
    qdot_expr r = qdot_integral_normal(t, qdot_sqrt(t->pool, qdot_integral_normal(t, v)));

    return r == QDOT_NIL ? r : qdot_walk_replace(t->pool, r, QDOT_FUN, without_bars, NULL);
}
