/* solve.c -- the set of roots of an equation, and what of it lies inside a domain. */
#include "normal/solve/solve.h"

#include <string.h>

#include "expr/walk.h"
#include "normal/field/flint.h"
#include "normal/prove/decide.h"
#include "normal/solve/solver.h"

/* Whether the root `one` lies in the family or range `all`. */
static bool
is_member(const qdot_solver *s, const qdot_root *one, const qdot_root *all)
{
    if (one == all || one->period != QDOT_NIL || one->value == s->x)
        return false;
    if (all->period != QDOT_NIL)
        return all->condition == QDOT_NIL && all->members == QDOT_NIL &&
               qdot_solver_is_member(s, all, one->value);
    return all->value == s->x && qdot_conditions_at(s->pool, all->condition, 1, &s->x,
                                                    &one->value, s->facts) == QDOT_NIL;
}

/* Remove roots that belong to a family or a range of x that is listed too. */
static qdot_status
leave_out_members(qdot_solver *s)
{
    qdot_root *at = s->out->root.at;
    size_t n = s->out->root.n, kept = 0;
    bool *out = qdot_calloc(n + 1, sizeof *out);

    if (out == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n && !out[i]; k++)
            out[i] = is_member(s, &at[i], &at[k]);
    for (size_t i = 0; i < n; i++)
        if (!out[i])
            at[kept++] = at[i];
    s->out->root.n = kept;
    qdot_free(out);
    return qdot_pool_check(s->pool);
}

static void
solve_guarded(void *user)
{
    qdot_solver *s = user;
    qdot_expr domain = qdot_conditions_all(
        s->pool, qdot_conditions_of_domain(s->pool, s->f, s->x), s->domain);

    s->status = qdot_pool_check(s->pool);
    if (s->status == QDOT_OK)
        s->status = qdot_solver_equation(s, s->f, domain);
    if (s->status == QDOT_OK)
        s->status = leave_out_members(s);
    if (s->status == QDOT_OK)
        s->status = qdot_solve_sort(s->pool, s->out->root.n, s->out->root.at);
}

static qdot_status
solve_where(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr domain, const qdot_facts *facts,
            qdot_solutions *out)
{
    qdot_solver s = {
        .pool = pool, .f = f, .x = x, .domain = domain, .facts = facts, .out = out};
    qdot_status status;

    *out = (qdot_solutions){.complete = true};
    QDOT_TRY(qdot_pool_check(pool));
    if (domain == QDOT_NIL && qdot_is_zero(pool, f, facts))
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    status = qdot_flint_run(pool, solve_guarded, &s);
    if (status != QDOT_OK) { /* what it allocated is there no more */
        *out = (qdot_solutions){0};
        return status == QDOT_ELIMIT ? QDOT_OK : status;
    }
    return s.status;
}

qdot_status
qdot_solve(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
           qdot_solutions *out)
{
    return solve_where(pool, f, x, QDOT_NIL, facts, out);
}

qdot_status
qdot_solve_unsolved(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
                    qdot_expr *list, bool *all)
{
    qdot_expr factors = qdot_solve_factors(pool, f), members = QDOT_NIL;

    QDOT_TRY(qdot_pool_check(pool));
    *all = true;
    for (uint32_t i = 0; i < qdot_expr_count(pool, factors); i++) {
        qdot_expr one = qdot_expr_arg(pool, factors, i);
        qdot_solutions found;
        qdot_status status;

        if (!qdot_expr_contains(pool, one, x))
            continue;
        status = qdot_solve(pool, one, x, facts, &found);
        *all = *all && !found.complete;
        if (status == QDOT_OK && !found.complete)
            members = qdot_conditions_and(pool, members, one);
        qdot_solutions_clear(&found);
        QDOT_TRY(status);
    }
    *list = members == QDOT_NIL ? qdot_list(pool, 0, NULL) : members;
    return qdot_pool_check(pool);
}

qdot_status
qdot_solve_inside(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr domain,
                  const qdot_facts *facts, qdot_solutions *out)
{
    qdot_solutions all;
    qdot_window window;
    bool angle = false;
    qdot_status status;

    *out = all = (qdot_solutions){0};
    if (domain != QDOT_NIL) /* what holds in all of the declared domain of x is decided before roots are put in */
        domain = qdot_conditions_at(pool, domain, 0, NULL, NULL, facts);
    status = solve_where(pool, f, x, domain, facts, &all);
    for (size_t i = 0; i < all.root.n && !angle; i++)
        angle = all.root.at[i].period != QDOT_NIL;
    angle = angle && status == QDOT_OK && qdot_is_angle(pool, f, x, facts);
    window = qdot_solve_window(pool, x, angle);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    out->complete = all.complete;
    for (size_t i = 0; i < all.root.n && status == QDOT_OK; i++)
        status = qdot_solve_members(pool, x, &all.root.at[i], &window, facts, out);
    out->recurs = out->recurs && out->root.n > 0;
    memcpy(&out->special, &all.special, sizeof out->special);
    memset(&all.special, 0, sizeof all.special);
    qdot_solutions_clear(&all);
    if (status == QDOT_OK)
        status = qdot_solve_sort(pool, out->root.n, out->root.at);
    return status;
}
