/* switch.c -- finds functions that switch (jump or have a kink) at a point. */
#include "normal/calculus/switch.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr ray; /* the parameter along a ray; 0 at the point */
    const qdot_facts *facts;
} place;

static bool
vanishes_at_point(const place *x, qdot_expr e)
{
    const qdot_expr zero = QDOT_ZERO;
    qdot_expr there = qdot_subs(x->pool, e, 1, &x->ray, &zero);

    if (there == QDOT_NIL) { /* the expression is undefined at the point */
        (void)!qdot_pool_check(x->pool);
        return false;
    }
    return qdot_is_zero(x->pool, there, x->facts);
}

/* Whether two of the arguments of a function (max, min), which depend on `ray`, are equal at the point. */
static bool
arguments_meet_at(const place *x, qdot_expr e)
{
    for (uint32_t i = 0; i < qdot_expr_count(x->pool, e); i++)
        for (uint32_t k = 0; k < i; k++)
            if (vanishes_at_point(x, qdot_sub(x->pool, qdot_expr_arg(x->pool, e, i),
                                              qdot_expr_arg(x->pool, e, k))))
                return true;
    return false;
}

static bool
is_integer_value(qdot_pool *pool, qdot_expr there)
{
    return there != QDOT_NIL && qdot_expr_kind(pool, there) == QDOT_NUM &&
           qdot_fun1(pool, QDOT_FLOOR, there) == there;
}

bool
qdot_switch_at(qdot_pool *pool, qdot_fun_id id, qdot_expr there, const qdot_facts *facts)
{
    if (id == QDOT_ABS || id == QDOT_SIGN)
        return qdot_is_zero(pool, there, facts);
    return id == QDOT_FLOOR && is_integer_value(pool, there);
}

/* Whether floor(e) jumps at the point because e is an integer there. */
static bool
floor_jumps(const place *x, qdot_expr e)
{
    const qdot_expr zero = QDOT_ZERO;
    bool whole = is_integer_value(x->pool, qdot_subs(x->pool, e, 1, &x->ray, &zero));

    (void)!qdot_pool_check(x->pool);
    return whole;
}

static bool
node_switches(const place *x, qdot_expr e)
{
    qdot_pool *pool = x->pool;
    const qdot_node *node = qdot_expr_node(pool, e);

    if (node->kind == QDOT_REL)
        return arguments_meet_at(x, e);
    if (node->kind != QDOT_FUN)
        return false;
    switch ((qdot_fun_id)node->op) {
    case QDOT_ABS:
    case QDOT_SIGN: return vanishes_at_point(x, qdot_expr_arg(pool, e, 0));
    case QDOT_MIN:
    case QDOT_MAX: return arguments_meet_at(x, e);
    case QDOT_FLOOR: return floor_jumps(x, qdot_expr_arg(pool, e, 0));
    case QDOT_MOD:
        return floor_jumps(
            x, qdot_div(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1)));
    default: return false;
    }
}

qdot_status
qdot_switch_find(qdot_pool *pool, qdot_expr e, qdot_expr ray, const qdot_facts *facts,
                 qdot_expr *part)
{
    const place x = {pool, ray, facts};
    qdot_vec(qdot_expr) parts = {0};
    qdot_status status = QDOT_OK;
    qdot_walk w;

    *part = QDOT_NIL;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (qdot_expr_contains(pool, w.at[i], ray))
            status = qdot_vec_push(&parts, w.at[i]);
    qdot_walk_end(&w);
    for (size_t i = 0; i < parts.n && status == QDOT_OK && *part == QDOT_NIL; i++)
        if (node_switches(&x, parts.at[i]))
            *part = parts.at[i];
    qdot_free(parts.at);
    return status;
}

bool
qdot_has_steps(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    static const qdot_fun_id steps[] = {QDOT_SIGN, QDOT_FLOOR, QDOT_MOD, QDOT_IF, QDOT_ATAN2};

    return qdot_expr_find_function(pool, e, sizeof steps / sizeof *steps, steps, x) != QDOT_NIL;
}
