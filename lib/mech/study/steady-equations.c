/* steady-equations.c -- the equations of motion in independent velocities. */
#include "mech/study/steady-parts.h"

#include <stdio.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"

enum { MOST_WORK = 12000, MOST_STEPS = 3 }; /* highest order of a pole */

bool
qdot_reduced_is_scaled(const qdot_reduced *r, size_t a)
{
    return qdot_expr_is_class(r->pool, r->u[a], QDOT_PARAM);
}

bool
qdot_reduced_turns(const qdot_reduced *r, size_t a)
{
    bool turns = !r->rests[r->independent[a]];

    for (size_t i = 0; i < r->n && qdot_reduced_is_scaled(r, a); i++)
        turns = turns || (!r->rests[i] && r->N[i * r->m + a] != QDOT_ZERO);
    return turns;
}

qdot_expr
qdot_reduced_velocity(const qdot_reduced *r, size_t i)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++)
        sum = qdot_add(r->pool, sum, qdot_mul(r->pool, r->N[i * r->m + a], r->u[a]));
    return sum;
}

qdot_expr
qdot_reduced_resting(const qdot_reduced *r, qdot_expr e)
{
    const qdot_expr zero = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++) {
        if (!qdot_reduced_turns(r, a))
            e = qdot_subs(r->pool, e, 1, &r->u[a], &zero);
    }
    return e == QDOT_NIL ? e : qdot_simplify(r->pool, e, &r->facts);
}

/* Coordinates that occur in no mass, force or constraint first: their velocities become the dependent ones. */
static void
order_coordinates(qdot_reduced *r, qdot_expr M, qdot_expr f)
{
    size_t at = 0;

    for (int held = 0; held < 2; held++)
        for (size_t i = 0; i < r->n; i++) {
            bool is = qdot_expr_contains(r->pool, M, r->q[i]) || qdot_expr_contains(r->pool, f, r->q[i]);

            for (size_t k = 0; k < r->s->constraints.n; k++)
                is = is || qdot_expr_contains(r->pool, r->s->constraints.at[k].f, r->q[i]);
            if (is == (held == 1))
                r->order[at++] = i;
        }
}

/* The slopes of constraint k along the velocities, in that order. */
static qdot_status
read_constraint(qdot_reduced *r, size_t k, qdot_expr *row)
{
    const qdot_constraint *c = &r->s->constraints.at[k];
    qdot_expr rest = c->kind == QDOT_HOLONOMIC ? QDOT_ZERO : c->f;

    if (c->kind == QDOT_ACCELERATION)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions with a constraint of accelerations (%.100s)", c->name);
    for (size_t i = 0; i < r->n; i++) {
        const qdot_expr q = r->q[r->order[i]], rate = qdot_symbol_jet(r->pool, q, 1), zero = QDOT_ZERO;

        row[i] = qdot_elimination_short(&r->x, qdot_diff(r->pool, c->f, c->kind == QDOT_HOLONOMIC ? q : rate));
        rest = qdot_subs(r->pool, rest, 1, &rate, &zero);
    }
    QDOT_TRY(qdot_pool_check(r->pool));
    if (!qdot_elimination_is_zero(&r->x, rest) || (qdot_mech_holds(r->s, c->f) & QDOT_HAS_TIME) != 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions where constraint %.100s moves by itself", c->name);
    return QDOT_OK;
}

/* N from the constraints. */
static qdot_status
eliminate_velocities(qdot_reduced *r)
{
    const size_t n = r->n, c = r->s->constraints.n;
    qdot_expr *row = qdot_calloc(n + n * n + 1, sizeof *row), *N = row + n;
    qdot_echelon e;
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_echelon_begin(&e, c, n, n);
    size_t a = 0;

    if (row == NULL)
        return status;
    for (size_t k = 0; k < c && status == QDOT_OK; k++) {
        status = read_constraint(r, k, row);
        if (status == QDOT_OK)
            status = qdot_echelon_add(&r->x, &e, row, &r->kept[k]);
    }
    if (status == QDOT_OK) {
        r->m = n - e.rank;
        qdot_echelon_null_space(r->pool, &e, N);
        for (size_t i = 0; i < n * r->m; i++)
            r->N[r->order[i / r->m] * r->m + i % r->m] = N[i];
        for (size_t i = 0; i < n; i++)
            if (!qdot_echelon_leads(&e, i)) {
                r->u[a] = qdot_symbol_jet(r->pool, r->q[r->order[i]], 1);
                r->independent[a++] = r->order[i];
            }
    }
    qdot_echelon_end(&e);
    qdot_free(row);
    return status == QDOT_OK ? qdot_pool_check(r->pool) : status;
}

/* Free column a of N of poles: multiply by the divisors in it that may be 0. */
static qdot_status
scale_column(qdot_reduced *r, size_t a)
{
    char name[40];
    bool scaled = false, more = true;

    for (int step = 0; step < MOST_STEPS && more; step++) {
        qdot_expr column = qdot_list(r->pool, 0, NULL), divisors;

        for (size_t i = 0; i < r->n; i++)
            column = qdot_list_appended(r->pool, column, 1, &r->N[i * r->m + a]);
        divisors = column == QDOT_NIL ? QDOT_NIL : qdot_conditions_of_divisors(r->pool, column, QDOT_NIL);
        QDOT_TRY(qdot_pool_check(r->pool));
        more = false;
        for (uint32_t k = 0; divisors != QDOT_NIL && k < qdot_expr_count(r->pool, divisors); k++) {
            const qdot_expr d = qdot_conditions_nonzero(r->pool, qdot_expr_arg(r->pool, divisors, k));

            if (d == QDOT_NIL || qdot_is_generic(r->pool, d) || (qdot_expr_node(r->pool, d)->sign & QDOT_NE0) != 0)
                continue;
            for (size_t i = 0; i < r->n; i++)
                r->N[i * r->m + a] = qdot_elimination_short(&r->x, qdot_mul(r->pool, r->N[i * r->m + a], d));
            scaled = more = true;
        }
    }
    if (!scaled)
        return qdot_pool_check(r->pool);
    snprintf(name, sizeof name, "(speed %zu)", a);
    r->u[a] = qdot_symbol_get(r->pool, QDOT_PARAM, name);
    if (r->u[a] != QDOT_NIL)
        qdot_symbol_hide(r->pool, r->u[a]);
    return qdot_pool_check(r->pool);
}

/* N' u of coordinate i: its acceleration while u is constant. */
static qdot_expr
drift_of(const qdot_reduced *r, size_t i)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++)
        for (size_t k = 0; k < r->n; k++) {
            const qdot_expr slope = qdot_diff(r->pool, r->N[i * r->m + a], r->q[k]);

            if (slope != QDOT_ZERO)
                sum = qdot_add(r->pool, sum, qdot_product(r->pool, 3, (qdot_expr[]){slope, qdot_reduced_velocity(r, k),
                                                                                   r->u[a]}));
        }
    return sum;
}

/* The entry of the scene's mass matrix for coordinates i, k. */
static qdot_expr
mass_entry(const qdot_reduced *r, qdot_expr M, size_t i, size_t k)
{
    return qdot_expr_arg(r->pool, M, (uint32_t)(r->own[i] * r->s->coordinates.n + r->own[k]));
}

/* M, R and g, with velocities in place of those that the constraints bind. */
static qdot_status
reduce_equations(qdot_reduced *r, qdot_expr M, qdot_expr f)
{
    const size_t n = r->n, m = r->m;
    qdot_expr *from = qdot_calloc(4 * n + 1, sizeof *from), *to = from + n, *drift = to + n, *force = drift + n;

    if (from == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        from[i] = qdot_symbol_jet(r->pool, r->q[i], 1);
        to[i] = qdot_reduced_velocity(r, i);
        drift[i] = drift_of(r, i);
    }
    for (size_t k = 0; k < r->states; k++)
        r->g[k] = qdot_elimination_short(&r->x, qdot_subs(r->pool, qdot_scene_with_rates(r->s, r->s->states.at[k].rate), n, from, to));
    for (size_t i = 0; i < n; i++) {
        const qdot_expr own = qdot_scene_with_rates(r->s, qdot_expr_arg(r->pool, f, (uint32_t)r->own[i]));

        force[i] = qdot_neg(r->pool, qdot_subs(r->pool, own, n, from, to));
        for (size_t k = 0; k < n; k++)
            if (drift[k] != QDOT_ZERO)
                force[i] = qdot_add(r->pool, force[i], qdot_mul(r->pool, mass_entry(r, M, i, k), drift[k]));
    }
    for (size_t a = 0; a < m; a++) {
        qdot_expr sum = QDOT_ZERO;

        for (size_t i = 0; i < n; i++)
            sum = qdot_add(r->pool, sum, qdot_mul(r->pool, r->N[i * m + a], force[i]));
        r->R[a] = qdot_elimination_short(&r->x, sum);
        for (size_t b = 0; b < m; b++) {
            sum = QDOT_ZERO;
            for (size_t i = 0; i < n * n; i++)
                sum = qdot_add(r->pool, sum, qdot_product(r->pool, 3, (qdot_expr[]){r->N[i / n * m + a],
                                                                                    mass_entry(r, M, i / n, i % n),
                                                                                    r->N[i % n * m + b]}));
            r->M[a * m + b] = qdot_elimination_short(&r->x, sum);
        }
    }
    qdot_free(from);
    return qdot_pool_check(r->pool);
}

/* Mark coordinate q as resting if e holds it; *more: one was marked. */
static void
mark_resting(qdot_reduced *r, qdot_expr e, bool *more)
{
    for (size_t i = 0; i < r->n; i++)
        if (!r->rests[i] && qdot_expr_contains(r->pool, e, r->q[i]))
            r->rests[i] = *more = true;
}

/* Whether e holds a coordinate that rests. */
static bool
holds_resting(const qdot_reduced *r, qdot_expr e)
{
    bool yes = false;

    for (size_t i = 0; i < r->n; i++)
        yes = yes || (r->rests[i] && qdot_expr_contains(r->pool, e, r->q[i]));
    return yes;
}

/* The coordinates that the equations hold, and those on which these depend: by their velocities or a holonomic constraint. */
static void
find_resting(qdot_reduced *r)
{
    bool more = false;

    for (size_t k = 0; k < r->m * r->m; k++)
        mark_resting(r, r->M[k], &more);
    for (size_t k = 0; k < r->m; k++)
        mark_resting(r, r->R[k], &more);
    for (size_t k = 0; k < r->states; k++)
        mark_resting(r, r->g[k], &more);
    while (more) {
        more = false;
        r->bound = 0;
        for (size_t i = 0; i < r->n; i++)
            for (size_t a = 0; a < r->m && r->rests[i]; a++)
                mark_resting(r, r->N[i * r->m + a], &more);
        for (size_t k = 0; k < r->s->constraints.n; k++)
            if (r->s->constraints.at[k].kind == QDOT_HOLONOMIC && holds_resting(r, r->s->constraints.at[k].f)) {
                mark_resting(r, r->s->constraints.at[k].f, &more);
                r->bound += r->kept[k];
            }
    }
}

void
qdot_reduced_end(qdot_reduced *r)
{
    qdot_free(r->own);
    qdot_free(r->N);
    qdot_free(r->rests);
}

qdot_status
qdot_reduced_begin(qdot_reduced *r, qdot_scene *s, qdot_expr keep)
{
    const qdot_expr M = qdot_released(s->pool, qdot_mech_numeric_mass(s)), f = qdot_released(s->pool, qdot_mech_numeric_forcing(s));
    const size_t n = s->coordinates.n;

    *r = (qdot_reduced){.s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .states = s->states.n};
    r->x = (qdot_elimination){.pool = s->pool, .facts = &r->facts, .most = MOST_WORK};
    QDOT_TRY(qdot_pool_check(s->pool));
    r->own = qdot_calloc(3 * n + 1, sizeof *r->own);
    r->N = qdot_calloc(2 * n * n + 3 * n + r->states + 1, sizeof *r->N);
    r->rests = qdot_calloc(n + s->constraints.n + 1, sizeof *r->rests);
    if (r->own == NULL || r->N == NULL || r->rests == NULL)
        return QDOT_ENOMEM;
    r->kept = r->rests + n;
    r->order = r->own + n;
    r->independent = r->order + n;
    r->M = r->N + n * n;
    r->R = r->M + n * n;
    r->q = r->R + n;
    r->u = r->q + n;
    r->g = r->u + n;
    for (size_t i = 0; i < n; i++)
        if (qdot_scene_state_of(s, s->coordinates.at[i]) == NULL) {
            r->q[r->n] = s->coordinates.at[i];
            r->own[r->n++] = i;
        }
    if ((qdot_mech_holds(s, f) & (QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER)) != 0 || (qdot_mech_holds(s, M) & QDOT_HAS_TIME) != 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: unknown rates of steady motions where forces hold t or multipliers");
    order_coordinates(r, M, f);
    QDOT_TRY(eliminate_velocities(r));
    for (size_t a = 0; a < r->m; a++)
        if (r->u[a] != keep)
            QDOT_TRY(scale_column(r, a));
    QDOT_TRY(reduce_equations(r, M, f));
    find_resting(r);
    return QDOT_OK;
}
