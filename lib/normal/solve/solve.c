/* solve.c -- finds the set of roots of an equation, and those of them that lie inside a domain. */
#include "normal/solve/solve.h"

#include <string.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/solve/sides.h"
#include "normal/solve/solver.h"

/* Whether the root `one` belongs to the family or range `all`, wherever it exists. */
static bool
belongs_to_family_or_range(const qdot_solver *s, const qdot_root *one, const qdot_root *all)
{
    qdot_expr room[QDOT_CONDITIONS_MOST];
    qdot_facts there;

    if (one == all || one->period != QDOT_NIL || one->value == s->x)
        return false;
    there = qdot_facts_and(s->pool, s->facts, one->condition, room);
    if (all->period != QDOT_NIL)
        return qdot_solver_is_member(s, all, one->value) &&
               qdot_conditions_at(s->pool, all->condition, 0, NULL, NULL, &there) == QDOT_NIL &&
               qdot_conditions_at(s->pool, all->members, 1, &s->x, &one->value, &there) == QDOT_NIL;
    return all->value == s->x && qdot_conditions_at(s->pool, all->condition, 1, &s->x,
                                                    &one->value, s->facts) == QDOT_NIL;
}

/* Remove roots that belong to a listed family or range. */
static qdot_status
remove_family_members(qdot_solver *s)
{
    qdot_root *at = s->out->root.at;
    size_t n = s->out->root.n, kept = 0;
    bool *out = qdot_calloc(n + 1, sizeof *out);

    if (out == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n && !out[i]; k++)
            out[i] = belongs_to_family_or_range(s, &at[i], &at[k]);
    for (size_t i = 0; i < n; i++)
        if (!out[i])
            at[kept++] = at[i];
    s->out->root.n = kept;
    qdot_free(out);
    return qdot_pool_check(s->pool);
}

static void
solve_equation_task(void *user)
{
    qdot_solver *s = user;
    qdot_expr domain = qdot_conditions_all(
        s->pool, qdot_conditions_of_domain(s->pool, s->f, s->x), s->written.domain);

    s->status = qdot_pool_check(s->pool);
    if (s->status == QDOT_OK)
        s->status = qdot_solver_equation(s, s->f, domain);
    if (s->status == QDOT_OK)
        s->status = remove_family_members(s);
    if (s->status == QDOT_OK)
        s->status = qdot_solve_sort(s->pool, s->out->root.n, s->out->root.at);
}

/* Powers with x in their exponents alone as exponentials: a^x = exp(x log(a)), a > 0. Nil: the node is no such power. */
static qdot_expr
as_exponential(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_expr x = *(const qdot_expr *)user;
    const uint32_t n = qdot_expr_kind(pool, node) == QDOT_PROD ? qdot_expr_count(pool, node) : 0;
    qdot_expr rest = node, exponent = QDOT_ZERO;

    for (uint32_t i = 1; i + 1 < n; i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, node, i), u = qdot_expr_arg(pool, node, i + 1);

        if (!qdot_expr_contains(pool, u, x) || qdot_expr_contains(pool, base, x) || qdot_expr_is_constant(pool, base))
            continue;
        rest = qdot_div(pool, rest, qdot_pow(pool, base, u));
        exponent = qdot_add(pool, exponent, qdot_mul(pool, u, qdot_fun1(pool, QDOT_LOG, base)));
    }
    return exponent == QDOT_ZERO ? QDOT_NIL : qdot_mul(pool, rest, qdot_fun1(pool, QDOT_EXP, exponent));
}

static qdot_status
solve_under_conditions(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_written *written, const qdot_facts *facts,
                       qdot_solutions *out)
{
    qdot_solver s = {.pool = pool, .f = f, .x = x, .written = *written, .facts = facts, .out = out};
    qdot_status status;
    bool single;

    *out = (qdot_solutions){0};
    QDOT_TRY(qdot_has_single_places(pool, 1, &f, 1, &x, facts, &single));
    s.f = f = qdot_walk_map(pool, f, as_exponential, &x);
    QDOT_TRY(qdot_pool_check(pool));
    out->complete = true;
    if (written->domain == QDOT_NIL && qdot_is_zero(pool, f, facts))
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    status = qdot_flint_run(pool, solve_equation_task, &s);
    if (status != QDOT_OK) { /* the results were freed when the solver failed */
        *out = (qdot_solutions){0};
        return status == QDOT_ELIMIT ? QDOT_OK : status;
    }
    out->single = single && out->complete;
    out->complete = out->complete && !single;
    return s.status;
}

qdot_status
qdot_solve(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
           qdot_solutions *out)
{
    return solve_under_conditions(pool, f, x, &(qdot_written){QDOT_NIL, QDOT_NIL}, facts, out);
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

/* --- ranges of x ---------------------------------------------------------------------- */

/* Whether f may be piecewise constant: it contains |u|, sign, max, min, if or floor of x. */
static qdot_status
may_be_piecewise_constant(qdot_pool *pool, qdot_expr f, qdot_expr x, bool *yes)
{
    *yes = qdot_sides_choice(pool, f, x) != QDOT_NIL ||
           qdot_expr_find_function(pool, f, 1, (qdot_fun_id[]){QDOT_FLOOR}, x) != QDOT_NIL;
    return qdot_pool_check(pool);
}

/* The set of conditions except those that bound x by constants. */
static qdot_expr
remove_constant_bounds(qdot_pool *pool, qdot_expr x, qdot_expr conditions)
{
    uint32_t n = conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, conditions);
    qdot_expr left = QDOT_NIL;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, conditions, i);
        const qdot_window w =
            qdot_solve_tighten(pool, x, qdot_list(pool, 1, &one), (qdot_window){0}, NULL);

        if (w.lo == QDOT_NIL && w.hi == QDOT_NIL)
            left = qdot_conditions_and(pool, left, one);
    }
    return left;
}

/* Add all x in the window that satisfy the conditions: a range, one point, or nothing. */
static qdot_status
add_range_of_solutions(qdot_pool *pool, qdot_expr x, qdot_expr conditions, const qdot_window *window,
                       qdot_solutions *out)
{
    const qdot_window w = qdot_solve_tighten(pool, x, conditions, *window, NULL);
    qdot_root one = {x, remove_constant_bounds(pool, x, conditions), QDOT_NIL, QDOT_NIL};
    bool open = w.lo_open || w.hi_open;

    QDOT_TRY(qdot_pool_check(pool));
    if (w.lo != QDOT_NIL && w.hi != QDOT_NIL) {
        qdot_expr length = qdot_sub(pool, w.hi, w.lo);

        if (qdot_condition(pool, length, open, NULL) == QDOT_FALSE)
            return QDOT_OK;
        if (qdot_is_zero(pool, length, NULL)) {
            one.condition = qdot_conditions_at(pool, one.condition, 1, &x, &w.lo, NULL);
            one.value = w.lo;
            QDOT_TRY(qdot_pool_check(pool));
            return one.condition == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&out->root, one);
        }
    }
    one.condition = qdot_conditions_all(pool, one.condition, qdot_window_relations(pool, &w, x));
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(&out->root, one);
}

/* Remove points that belong to a listed range. */
static void
remove_points_in_ranges(qdot_pool *pool, qdot_expr x, qdot_solutions *out)
{
    size_t kept = 0;

    for (size_t i = 0; i < out->root.n; i++) {
        const qdot_root one = out->root.at[i];
        bool inside = false;

        for (size_t k = 0; k < out->root.n && one.value != x && !inside; k++)
            inside = out->root.at[k].value == x &&
                     qdot_conditions_at(pool, out->root.at[k].condition, 1, &x, &one.value,
                                        NULL) == QDOT_NIL;
        if (!inside)
            out->root.at[kept++] = one;
    }
    out->root.n = kept;
}

qdot_status
qdot_solve_ranges(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr domain,
                  const qdot_window *window, qdot_solutions *out)
{
    qdot_solutions all = {0};
    qdot_status status;
    bool pieces, ranges = false;

    *out = (qdot_solutions){0};
    QDOT_TRY(may_be_piecewise_constant(pool, f, x, &pieces));
    if (!pieces)
        return QDOT_OK;
    status = solve_under_conditions(pool, f, x, &(qdot_written){domain, QDOT_NIL}, NULL, &all);
    for (size_t i = 0; i < all.root.n && !ranges; i++)
        ranges = all.root.at[i].value == x;
    out->complete = all.complete && ranges;
    for (size_t i = 0; i < all.root.n && ranges && status == QDOT_OK; i++) {
        const qdot_root *root = &all.root.at[i];

        status = root->value == x
                     ? add_range_of_solutions(pool, x, qdot_conditions_reduce(pool, root->condition, NULL), window, out)
                     : qdot_solve_members(pool, x, root, window, NULL, out);
    }
    qdot_solutions_clear(&all);
    QDOT_TRY(status);
    remove_points_in_ranges(pool, x, out);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_solve_sort(pool, out->root.n, out->root.at);
}

qdot_status
qdot_solve_written(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_written *written,
                   const qdot_facts *facts, qdot_solutions *out)
{
    qdot_written w = *written;
    qdot_solutions all;
    qdot_window window;
    bool angle = false;
    qdot_status status;

    *out = all = (qdot_solutions){0};
    if (w.domain != QDOT_NIL) /* decide what holds on the whole domain of x before inserting roots */
        w.domain = qdot_conditions_at(pool, w.domain, 0, NULL, NULL, facts);
    status = solve_under_conditions(pool, f, x, &w, facts, &all);
    for (size_t i = 0; i < all.root.n && !angle; i++)
        angle = all.root.at[i].period != QDOT_NIL;
    angle = angle && status == QDOT_OK && qdot_is_angle(pool, f, x, facts);
    window = qdot_solve_tighten(pool, x, w.domain, qdot_solve_window(pool, x, false), facts);
    if (angle)
        window = qdot_window_turn(pool, window);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    out->complete = all.complete;
    out->single = all.single;
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

qdot_status
qdot_solve_inside(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr domain,
                  const qdot_facts *facts, qdot_solutions *out)
{
    return qdot_solve_written(pool, f, x, &(qdot_written){domain, QDOT_NIL}, facts, out);
}
