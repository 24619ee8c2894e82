/* solve-cases.c -- equations with |u(x)|, sign u(x), max, min and if(...): solved case by case. */
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/solve/solver.h"

qdot_expr
qdot_solver_choice(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    static const qdot_fun_id choices[] = {QDOT_ABS, QDOT_SIGN, QDOT_MAX, QDOT_MIN, QDOT_IF};

    return qdot_expr_find_function(pool, e, sizeof choices / sizeof *choices, choices, x);
}

/* e with `to` in place of the node `choice`, where the relation holds. */
static qdot_status
one_case(qdot_solver *s, qdot_expr e, qdot_expr choice, qdot_expr to, qdot_expr relation,
         qdot_expr when)
{
    qdot_expr there = qdot_subs(s->pool, e, 1, &choice, &to);

    return qdot_solver_equation(s, there, qdot_conditions_and(s->pool, when, relation));
}

/* Those members of a family at which e, which is not as periodic, is 0: value + n period for the integers n that
 * solve e = 0. */
static qdot_status
members_with(qdot_solver *s, qdot_expr e, const qdot_root *root, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr n = qdot_solve_integer(pool, 0),
              value = qdot_add(pool, root->value, qdot_mul(pool, n, root->period)),
              at = qdot_solve_without_turns(pool, qdot_subs(pool, e, 1, &s->x, &value));
    qdot_solutions found = {.complete = true};
    qdot_solver inner = {.pool = pool, .f = at, .x = n, .facts = s->facts, .out = &found,
                         .depth = s->depth};
    qdot_status status = qdot_pool_check(pool);

    if (status == QDOT_OK)
        status = qdot_solver_equation(&inner, at, QDOT_NIL);
    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++) {
        qdot_expr k = found.root.at[i].value;
        const fmpq *whole = qdot_expr_rational(pool, k);

        if (whole == NULL)
            s->out->complete = false;
        else if (fmpz_is_one(fmpq_denref(whole)))
            status = qdot_solver_add(s, qdot_add(pool, root->value, qdot_mul(pool, k, root->period)),
                                     QDOT_NIL, qdot_conditions_all(pool, when, found.root.at[i].condition));
    }
    s->out->complete = s->out->complete && found.complete;
    qdot_solutions_clear(&found);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Roots of u, at which sign u jumps: those at which e itself is proved to be 0. */
static qdot_status
at_the_jump(qdot_solver *s, qdot_expr e, qdot_expr u, qdot_expr when)
{
    qdot_solutions found = {.complete = true};
    qdot_solver inner = {.pool = s->pool, .f = u, .x = s->x, .facts = s->facts, .out = &found,
                         .depth = s->depth};
    qdot_status status = qdot_solver_equation(&inner, u, QDOT_NIL);

    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++) {
        qdot_root *root = &found.root.at[i];
        qdot_expr at = qdot_subs(s->pool, e, 1, &s->x, &root->value),
                  all = qdot_conditions_all(s->pool, when, root->condition);

        if (root->period != QDOT_NIL && !qdot_is_period(s->pool, e, s->x, root->period, s->facts)) {
            status = members_with(s, e, root, all);
        } else if (at == QDOT_NIL) {
            status = qdot_pool_check(s->pool);
            status = status == QDOT_EDOMAIN ? QDOT_OK : status;
        } else if (qdot_is_zero(s->pool, at, s->facts)) {
            status = qdot_solver_add(s, root->value, root->period, all);
        } else if (!qdot_is_generic(s->pool, at) || /* other unknowns may make it one */
                   (root->period == QDOT_NIL && s->facts != NULL && s->facts->exact)) {
            status = qdot_solver_add_where(s, root->value, at, all);
        }
    }
    s->out->complete = s->out->complete && found.complete;
    qdot_solutions_clear(&found);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

static qdot_status
is_defined_with(qdot_pool *pool, qdot_expr e, qdot_expr from, qdot_expr to, bool *yes)
{
    qdot_status status;

    (void)qdot_subs(pool, e, 1, &from, &to);
    status = qdot_pool_check(pool);
    *yes = status == QDOT_OK;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* |u| or sign u, in e: u on either side of 0; the ends belong to both where nothing jumps. */
static qdot_status
by_sign(qdot_solver *s, qdot_expr e, qdot_expr u, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr from[2] = {qdot_fun1(pool, QDOT_ABS, u), qdot_fun1(pool, QDOT_SIGN, u)};
    bool jumps = qdot_expr_contains(pool, e, from[1]), defined;
    qdot_rel_op op;

    QDOT_TRY(is_defined_with(pool, e, from[0], QDOT_ZERO, &defined));
    op = jumps || !defined ? QDOT_LT : QDOT_LE;

    for (long sign = 1; sign >= -1; sign -= 2) {
        qdot_expr side = qdot_expr_int(pool, sign), to[2] = {qdot_mul(pool, side, u), side},
                  there = qdot_subs(pool, e, 2, from, to);

        QDOT_TRY(qdot_solver_equation(
            s, there,
            qdot_conditions_and(pool, when, qdot_rel(pool, op, QDOT_ZERO, to[0]))));
    }
    return jumps ? at_the_jump(s, e, u, when) : QDOT_OK;
}

/* The largest (least) of the arguments: each, where it is. */
static qdot_status
by_largest(qdot_solver *s, qdot_expr e, qdot_expr choice, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    bool largest = qdot_expr_node(pool, choice)->op == QDOT_MAX;
    uint32_t n = qdot_expr_count(pool, choice);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr it = qdot_expr_arg(pool, choice, i), there = when;

        for (uint32_t k = 0; k < n; k++) {
            qdot_expr other = qdot_expr_arg(pool, choice, k);

            if (k != i)
                there = qdot_conditions_and(pool, there,
                                            largest ? qdot_rel(pool, QDOT_LE, other, it)
                                                    : qdot_rel(pool, QDOT_LE, it, other));
        }
        QDOT_TRY(one_case(s, e, choice, it, QDOT_TRUE, there));
    }
    return QDOT_OK;
}

/* if(a < b, ...): either side. */
static qdot_status
by_condition(qdot_solver *s, qdot_expr e, qdot_expr choice, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr c = qdot_expr_arg(pool, choice, 0), left, right;
    bool strict;

    if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ) {
        s->out->complete = false;
        return QDOT_OK;
    }
    strict = qdot_expr_node(pool, c)->op == QDOT_LT;
    left = qdot_expr_arg(pool, c, 0);
    right = qdot_expr_arg(pool, c, 1);
    QDOT_TRY(one_case(s, e, choice, qdot_expr_arg(pool, choice, 1), c, when));
    return one_case(s, e, choice, qdot_expr_arg(pool, choice, 2),
                    qdot_rel(pool, strict ? QDOT_LE : QDOT_LT, right, left), when);
}

qdot_status
qdot_solver_cases(qdot_solver *s, qdot_expr e, qdot_expr choice, qdot_expr when)
{
    switch (qdot_expr_node(s->pool, choice)->op) {
    case QDOT_MAX:
    case QDOT_MIN: return by_largest(s, e, choice, when);
    case QDOT_IF: return by_condition(s, e, choice, when);
    default: return by_sign(s, e, qdot_expr_arg(s->pool, choice, 0), when);
    }
}
