/* state-values.c -- expressions at a state of a scene, in symbols or in numbers. */
#include "mech/linear/state-values.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"

enum {
    BITS = 192,      /* precision of the balls */
    MOST_WORK = 12000 /* operations in expressions simplified for one linear motion */
};

void
qdot_state_values_begin(qdot_state_values *v, qdot_scene *s, bool numbers, qdot_binder bind, void *user)
{
    *v = (qdot_state_values){.s = s, .facts = qdot_scene_facts(s), .bind = bind, .user = user};
    v->x = (qdot_elimination){.pool = s->pool, .numbers = numbers, .facts = &v->facts, .most = MOST_WORK};
}

void
qdot_state_values_end(qdot_state_values *v)
{
    qdot_free(v->symbols.at);
    qdot_free(v->values.at);
}

qdot_status
qdot_state_values_put(qdot_state_values *v, qdot_expr symbol, qdot_expr value)
{
    for (size_t i = 0; i < v->symbols.n; i++)
        if (v->symbols.at[i] == symbol)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&v->symbols, symbol));
    return qdot_vec_push(&v->values, value);
}

/* --- in numbers ------------------------------------------------------------------------- */

/* Fail because a symbol in e has no value. */
static qdot_status
report_symbol_without_value(qdot_pool *pool, qdot_expr e)
{
    const qdot_expr atoms = qdot_expr_atoms(pool, e, true);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        const qdot_expr x = qdot_expr_arg(pool, atoms, i);
        const qdot_symbol *symbol = qdot_expr_symbol(pool, x);
        const char *name = symbol != NULL ? symbol->name : qdot_ufun_get(pool, qdot_expr_node(pool, x)->op)->name;

        if (symbol != NULL && symbol->class == QDOT_CONST)
            continue;
        (void)qdot_fail(QDOT_EUNSET, "the linear motion is found in numbers only, which need a value of `%.100s`", name);
        return symbol != NULL && (symbol->class == QDOT_COORD || symbol->class == QDOT_TIME)
                   ? qdot_hint("at [%.100s = ..., ...]", name)
                   : qdot_hint("set %.100s%s = ...", name, symbol != NULL ? "" : "(...)");
    }
    return qdot_fail(QDOT_EDOMAIN, "the equations of motion have no linear part there");
}

/* The middle of a ball as a rational; 0 where it cannot be told from 0. */
static qdot_expr
middle_of_ball(qdot_pool *pool, arb_srcptr ball)
{
    qdot_expr value;
    fmpq_t x;

    if (arb_contains_zero(ball))
        return QDOT_ZERO;
    fmpq_init(x);
    arf_get_fmpq(x, arb_midref(ball));
    value = qdot_expr_fmpq(pool, x);
    fmpq_clear(x);
    return value;
}

static qdot_status
evaluate_constants(qdot_pool *pool, size_t n, qdot_expr *e)
{
    qdot_ball ball;
    qdot_status status = QDOT_OK;
    size_t unknown = n;

    QDOT_TRY(qdot_ball_begin(&ball, pool, n, e));
    qdot_ball_eval(&ball, BITS, NULL, NULL);
    for (size_t i = 0; i < n && unknown == n; i++) {
        arb_srcptr value = qdot_ball_get(&ball, e[i]);

        if (qdot_expr_kind(pool, e[i]) == QDOT_NUM)
            continue;
        if (value == NULL || !arb_is_finite(value))
            unknown = i;
        else
            e[i] = middle_of_ball(pool, value);
    }
    qdot_ball_end(&ball);
    if (unknown < n)
        status = report_symbol_without_value(pool, e[unknown]);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* --- values --------------------------------------------------------------------------------- */

/* The value of e, in symbols or bound. */
static qdot_expr
value_at_state(qdot_state_values *v, qdot_expr e)
{
    e = qdot_subs(v->s->pool, e, v->symbols.n, v->symbols.at, v->values.at);
    return v->x.numbers && e != QDOT_NIL ? v->bind(v->user, e) : e;
}

/* Fail where a sign(u) with u = 0 at the state makes a difference: e jumps there, or that of which it is a slope has a kink. */
static qdot_status
need_no_jump(qdot_state_values *v, qdot_expr e)
{
    static const qdot_expr sides[] = {QDOT_ONE, QDOT_MINUS_ONE};
    qdot_pool *pool = v->s->pool;
    bool jumps = false;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && !jumps && !qdot_pool_failed(pool); i++) {
        qdot_expr on[2];

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || qdot_expr_node(pool, w.at[i])->op != QDOT_SIGN ||
            !qdot_is_zero(pool, value_at_state(v, qdot_expr_arg(pool, w.at[i], 0)), &v->facts))
            continue;
        for (int k = 0; k < 2; k++)
            on[k] = value_at_state(v, qdot_subs(pool, e, 1, &w.at[i], &sides[k]));
        jumps = !qdot_is_zero(pool, qdot_sub(pool, on[0], on[1]), &v->facts);
    }
    qdot_walk_end(&w);
    QDOT_TRY(qdot_pool_check(pool));
    return jumps ? qdot_fail(QDOT_EDOMAIN, "the equations of motion have no linear part there: a force has a jump or a kink")
                 : QDOT_OK;
}

qdot_status
qdot_state_values_of(qdot_state_values *v, size_t n, qdot_expr *e)
{
    qdot_pool *pool = v->s->pool;

    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(need_no_jump(v, e[i]));
        e[i] = value_at_state(v, e[i]);
        if (!v->x.numbers)
            e[i] = qdot_elimination_short(&v->x, e[i]);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return v->x.numbers && n > 0 ? evaluate_constants(pool, n, e) : QDOT_OK;
}
