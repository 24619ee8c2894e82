/* accel.c -- q'' solved for, multipliers eliminated with it:
 *
 *     [ M  -A^T ] [ q''    ]   [ f      ]
 *     [ A   0   ] [ lambda ] = [ -gamma ],   A q'' + gamma = 0
 *
 * the constraints, differentiated as often as their kind asks. Constraints that repeat others
 * are left out (mech/dynamics/freedom.c): q'' does not depend on how they share the reaction. Rows
 * of velocity constraints in disguise are those of their integrals (mech/dynamics/integrated.h).
 *
 * The row of a state z' = g is z'' - dg/dq' q'' = dg/dt at q'' = 0, and z' stands nowhere else: g is in its place.
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/dynamics/freedom.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/lagrange.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"
#include "normal/solve/linear.h"

static qdot_status
fill_constraint_row(qdot_scene *s, size_t k, size_t row, size_t size, qdot_expr *A,
                    qdot_expr *b)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n;
    const qdot_constraint *c = &s->constraints.at[k];
    qdot_expr mu, F = qdot_integrated_of(s, k, &mu), f = F == QDOT_NIL ? c->f : F;

    for (int order = F == QDOT_NIL ? c->kind : QDOT_HOLONOMIC; order < QDOT_ACCELERATION; order++)
        f = qdot_ddt(pool, f);
    for (size_t i = 0; i < n; i++) {
        qdot_expr slope = qdot_integrated_slope(s, k, i);

        slope = qdot_mech_tidy(s, slope);
        A[row * size + i] = slope;
        A[i * size + row] = qdot_neg(pool, slope);
    }
    b[row] = qdot_neg(pool, qdot_mech_at_rest(s, f));
    return qdot_pool_check(pool);
}

/* The row of the state at coordinate i. */
static void
fill_state_row(qdot_scene *s, const qdot_state *state, size_t i, size_t size, qdot_expr *A, qdot_expr *b)
{
    qdot_pool *pool = s->pool;

    for (size_t j = 0; j < s->coordinates.n; j++)
        A[i * size + j] = j == i ? QDOT_ONE
                                 : qdot_neg(pool, qdot_diff(pool, state->rate, qdot_mech_jet(s, j, 1)));
    b[i] = qdot_mech_at_rest(s, qdot_ddt(pool, state->rate));
}

static qdot_status
solve_for_accelerations(qdot_scene *s, qdot_expr *A, qdot_expr *b, qdot_expr *x, size_t size,
                        const size_t *which)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    size_t n = s->coordinates.n;
    uint32_t pivot = 0;
    qdot_status status;

    for (size_t i = 0; i < size * size; i++)
        A[i] = QDOT_ZERO;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i; j < n; j++)
            A[i * size + j] = A[j * size + i] = qdot_mass_of_lagrangian(s, i, j);
        b[i] = qdot_lagrange_people_forcing(s, i);
    }
    for (size_t i = 0; i < n && s->states.n > 0; i++) {
        const qdot_state *state = qdot_scene_state_of(s, s->coordinates.at[i]);

        if (state)
            fill_state_row(s, state, i, size, A, b);
        b[i] = qdot_scene_with_rates(s, b[i]);
    }
    for (size_t row = n; row < size; row++)
        QDOT_TRY(fill_constraint_row(s, which[row - n], row, size, A, b));
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve_linear(pool, (uint32_t)size, A, b, x, &pivot, &facts);
    if (status == QDOT_ESINGULAR) {
        if (pivot >= n)
            return qdot_fail(status,
                             "constraint %s cannot be held: it repeats others or no "
                             "mass follows it",
                             s->constraints.at[which[pivot - n]].name);
        qdot_fail(status, "%s'' is not determined: the mass matrix is singular in %s",
                  qdot_expr_symbol(pool, s->coordinates.at[pivot])->name,
                  qdot_expr_symbol(pool, s->coordinates.at[pivot])->name);
        return qdot_hint("nothing with mass moves with it");
    }
    return status;
}

/* The multiplier of constraint k as declared: that of its equation, times the integrating factor if it was integrated. */
static qdot_expr
declared_multiplier(qdot_scene *s, size_t k, qdot_expr lambda)
{
    qdot_expr mu;

    if (qdot_integrated_of(s, k, &mu) == QDOT_NIL || mu == QDOT_ONE)
        return lambda;
    return qdot_mech_tidy(s, qdot_mul(s->pool, mu, lambda));
}

static bool
compute_accelerations(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n, size = n, *which;
    qdot_expr *work;
    bool done = false;

    if (d->accel)
        return true;
    if (!qdot_freedom_independent(s))
        return false;
    which = qdot_calloc(s->constraints.n + 1, sizeof *which);
    for (size_t k = 0; which && k < s->constraints.n; k++)
        if (d->independent[k])
            which[size++ - n] = k;
    work = which ? qdot_calloc(size * size + 2 * size + 1, sizeof *work) : NULL;
    if (work &&
        solve_for_accelerations(s, work, work + size * size, work + size * size + size, size, which) ==
            QDOT_OK &&
        qdot_derived_array(s, &d->accel, n)) {
        for (size_t i = 0; i < n; i++)
            d->accel[i] = work[size * size + size + i];
        done = !qdot_pool_failed(s->pool) &&
               qdot_derived_array(s, &d->lambda, s->constraints.n);
        for (size_t k = n; done && k < size && size - n == s->constraints.n; k++)
            d->lambda[which[k - n]] =
                declared_multiplier(s, which[k - n], work[size * size + size + k]);
        if (!done) {
            qdot_free(d->accel);
            d->accel = NULL;
        }
    } else {
        qdot_pool_fail(s->pool);
    }
    qdot_free(work);
    qdot_free(which);
    return done;
}

qdot_expr
qdot_mech_accel(qdot_scene *s, qdot_expr q)
{
    size_t i;

    if (!qdot_mech_index(s, q, &i) || !compute_accelerations(s))
        return QDOT_NIL;
    return s->derived->accel[i];
}

qdot_expr
qdot_mech_multiplier(qdot_scene *s, size_t k)
{
    return compute_accelerations(s) ? s->derived->lambda[k] : QDOT_NIL;
}

qdot_expr
qdot_mech_accels(qdot_scene *s)
{
    size_t n = s->coordinates.n;

    if (!compute_accelerations(s))
        return QDOT_NIL;
    return qdot_list(s->pool, (uint32_t)n, s->derived->accel);
}
