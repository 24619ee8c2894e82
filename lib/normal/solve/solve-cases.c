/* solve-cases.c -- equations with |u(x)|, sign u(x), max, min and if(...): solved case by case. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "normal/prove/decide.h"
#include "normal/solve/sides.h"
#include "normal/solve/solver.h"

/* Those members of a family at which e, which is not as periodic, is 0: value + n period for the integers n that
 * solve e = 0. */
static qdot_status
add_members_with_zero(qdot_solver *s, qdot_expr e, const qdot_root *root, qdot_expr when)
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

/* Add the roots of u, at which sign u jumps, if e itself is proved to vanish there. */
static qdot_status
add_roots_at_jump(qdot_solver *s, qdot_expr e, qdot_expr u, qdot_expr when)
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
            status = add_members_with_zero(s, e, root, all);
        } else if (at == QDOT_NIL) {
            status = qdot_pool_check(s->pool);
            status = status == QDOT_EDOMAIN ? QDOT_OK : status;
        } else if (qdot_is_zero(s->pool, at, s->facts)) {
            status = qdot_solver_add(s, root->value, root->period, all);
        /* e is not proved to be 0 here, but may be for some values of the other symbols: a root with a condition */
        } else if (!qdot_is_generic(s->pool, at) ||
                   root->period == QDOT_NIL) {
            status = qdot_solver_add_where(s, root->value, at, all);
        }
    }
    s->out->complete = s->out->complete && found.complete;
    qdot_solutions_clear(&found);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

qdot_status
qdot_solver_cases(qdot_solver *s, qdot_expr e, qdot_expr choice, qdot_expr when)
{
    qdot_sides sides;
    qdot_status status = qdot_sides_of(s->pool, e, choice, &sides);

    s->out->complete = s->out->complete && sides.n > 0;
    for (size_t i = 0; i < sides.n && status == QDOT_OK; i++)
        status = qdot_solver_equation(s, qdot_sides_put(&sides, i, e),
                                      qdot_conditions_all(s->pool, when, sides.relations[i]));
    if (status == QDOT_OK && sides.jump != QDOT_NIL)
        status = add_roots_at_jump(s, e, sides.jump, when);
    qdot_sides_clear(&sides);
    return status;
}
