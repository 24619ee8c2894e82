/* lagrange.c -- Lagrange's equations, the velocity terms from dM:
 *
 *     d/dt dT/dq_i' - dT/dq_i = sum_j M_ij q_j''
 *         + sum_jk (dM_ij/dq_k - 1/2 dM_jk/dq_i) q_j' q_k'
 *         + sum_j (dM_ij/dt + db_i/dq_j - db_j/dq_i) q_j' + db_i/dt - dc/dq_i
 */
#include "mech/dynamics/lagrange.h"

#include <stdlib.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "mech/dynamics/alike.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"
#include "normal/form/common.h"
#include "normal/form/simple.h"

/* A contribution halves/2 times e to the coefficient of q_j' q_k', j <= k. */
typedef struct {
    uint32_t j, k;
    qdot_expr e;
    int halves;
} coefficient;

static int
compare_velocity_pairs(const void *a, const void *b)
{
    const coefficient *x = a, *y = b;

    if (x->j != y->j)
        return x->j < y->j ? -1 : 1;
    if (x->k != y->k)
        return x->k < y->k ? -1 : 1;
    return x->e < y->e ? -1 : x->e > y->e;
}

/* Collect the contributions of derivatives of M to equation i; those by t go to *linear, as
 * coefficients of q_j'. */
static qdot_status
collect_mass_derivatives(qdot_scene *s, uint32_t i, coefficient *out, size_t *n_out, qdot_expr *linear)
{
    qdot_pool *pool = s->pool;
    const qdot_derived *d = s->derived;
    size_t n = 0;

    for (size_t a = 0; a < d->slopes.n; a++) {
        qdot_mass_slope m = d->slopes.at[a];
        bool row = m.j == i || m.k == i;
        uint32_t other = m.j == i ? m.k : m.j;

        if (m.i == d->n) {
            if (row)
                linear[other] = qdot_add(pool, linear[other], m.value);
            continue;
        }
        if (row)
            out[n++] = (coefficient){other < m.i ? other : m.i, other < m.i ? m.i : other,
                                     m.value, 2};
        if (m.i == i)
            out[n++] = (coefficient){m.j, m.k, m.value, m.j == m.k ? -1 : -2};
    }
    if (n > 1)
        qsort(out, n, sizeof *out, compare_velocity_pairs);
    *n_out = n;
    return qdot_pool_check(pool);
}

/* The sum of contributions [n] to one pair. Most cancel before anything is built: a link's angle
 * stands in one row and one column. */
static qdot_expr
sum_velocity_terms(qdot_pool *pool, const coefficient *at, size_t n)
{
    qdot_expr c = QDOT_ZERO;

    for (size_t a = 0, b; a < n; a = b) {
        int halves = 0;

        for (b = a; b < n && at[b].e == at[a].e; b++)
            halves += at[b].halves;
        if (halves == 2)
            c = qdot_add(pool, c, at[a].e);
        else if (halves != 0)
            c = qdot_add(pool, c,
                         qdot_mul(pool, qdot_expr_ratio(pool, halves, 2), at[a].e));
    }
    return c;
}

/* The terms of an equation that are linear or constant in velocities, from derivatives of b, c of T and by t. */
static qdot_expr
linear_and_constant_terms(qdot_scene *s, size_t i, qdot_expr *linear)
{
    qdot_pool *pool = s->pool;
    const qdot_derived *d = s->derived;
    qdot_expr q = s->coordinates.at[i], sum;

    sum = qdot_sub(pool, qdot_diff(pool, d->b[i], QDOT_T), qdot_diff(pool, d->c, q));
    sum = qdot_mech_tidy(s, sum);
    for (size_t j = 0; j < d->n; j++) {
        if (j != i) {
            qdot_expr curl =
                qdot_sub(pool, qdot_diff(pool, d->b[i], s->coordinates.at[j]),
                         qdot_diff(pool, d->b[j], q));

            linear[j] = qdot_add(pool, linear[j], curl);
        }
        if (linear[j] != QDOT_ZERO)
            sum = qdot_add(
                pool, sum,
                qdot_mul(pool, qdot_mech_tidy(s, linear[j]), qdot_mech_jet(s, j, 1)));
    }
    return sum;
}

qdot_expr
qdot_lagrange_rest(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d;
    size_t n, m = 0, terms = 0;
    coefficient *all = NULL;
    qdot_expr *linear = NULL, *sum = NULL, rest = QDOT_NIL;

    if (!qdot_mass_slopes(s))
        return QDOT_NIL;
    d = qdot_derived_get(s);
    n = d->n;
    if (!qdot_derived_array(s, &d->rest, n))
        return QDOT_NIL;
    if (d->rest[i] != QDOT_NIL)
        return d->rest[i];
    all = qdot_calloc(2 * d->slopes.n + 1, sizeof *all);
    linear = qdot_calloc(n, sizeof *linear);
    sum = qdot_calloc(2 * d->slopes.n + 2, sizeof *sum);
    if (!all || !linear || !sum) {
        qdot_pool_fail(pool);
        goto done;
    }
    for (size_t j = 0; j < n; j++)
        linear[j] = QDOT_ZERO;
    if (collect_mass_derivatives(s, (uint32_t)i, all, &m, linear) != QDOT_OK) {
        qdot_pool_fail(pool);
        goto done;
    }
    for (size_t a = 0, b; a < m; a = b) {
        qdot_expr c;

        for (b = a; b < m && all[b].j == all[a].j && all[b].k == all[a].k; b++)
            continue;
        c = sum_velocity_terms(pool, &all[a], b - a);
        if (c == QDOT_ZERO)
            continue;
        if (b - a > 1)
            c = qdot_mech_alike(s, c);
        sum[terms++] = qdot_mul(
            pool, c,
            qdot_mul(pool, qdot_mech_jet(s, all[a].j, 1), qdot_mech_jet(s, all[a].k, 1)));
    }
    sum[terms++] = linear_and_constant_terms(s, i, linear);
    rest = d->rest[i] = qdot_sum(pool, terms, sum);
done:
    qdot_free(all);
    qdot_free(linear);
    qdot_free(sum);
    return rest;
}

qdot_expr
qdot_lagrange_forcing(qdot_scene *s, qdot_expr F, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr p;

    if (qdot_scene_state_of(s, s->coordinates.at[i]))
        return QDOT_ZERO;
    p = qdot_diff(pool, F, qdot_mech_jet(s, i, 1));
    return qdot_sub(pool, qdot_diff(pool, F, s->coordinates.at[i]),
                    qdot_mech_at_rest(s, qdot_ddt(pool, p)));
}

qdot_expr
qdot_lagrange_people_forcing(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr Q = qdot_force_of_state(s, i);

    if (Q != QDOT_NIL)
        return Q;
    Q = qdot_mech_at_rest(s, qdot_mech_force(s, s->coordinates.at[i]));
    if (qdot_mech_stated(s))
        return qdot_add(pool, Q, qdot_lagrange_forcing(s, s->lagrangian, i));
    return qdot_sub(pool, Q, qdot_lagrange_rest(s, i));
}

/* The left side d/dt dT/dq' - dT/dq of equation i, with the Lagrangian L in place of T if one is stated. */
static qdot_expr
left_side_of_equation(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n, terms = 0;
    qdot_expr *sum, left;

    if (!qdot_derived_array(s, &d->left, n))
        return QDOT_NIL;
    if (d->left[i] != QDOT_NIL)
        return d->left[i];
    if (qdot_mech_stated(s)) {
        left = qdot_ddt(pool, qdot_diff(pool, s->lagrangian, qdot_mech_jet(s, i, 1)));
        left = qdot_sub(pool, left, qdot_diff(pool, s->lagrangian, s->coordinates.at[i]));
        return d->left[i] = qdot_common_out(pool, qdot_mech_tidy(s, left));
    }
    if (!qdot_mass_get(s))
        return QDOT_NIL;
    sum = qdot_calloc(n + 1, sizeof *sum);
    if (!sum)
        return qdot_pool_fail(pool);
    for (size_t j = 0; j < n; j++)
        if (qdot_mass_entry(s, i, j) != QDOT_ZERO)
            sum[terms++] =
                qdot_mul(pool, qdot_mass_entry(s, i, j), qdot_mech_jet(s, j, 2));
    sum[terms++] = qdot_lagrange_rest(s, i);
    left = qdot_sum(pool, terms, sum);
    qdot_free(sum);
    if (left == QDOT_NIL || !qdot_simple_is_collected(pool, left))
        left = qdot_mech_tidy_whole(s, left);
    return d->left[i] = qdot_common_out(pool, left);
}

qdot_expr
qdot_mech_equation(qdot_scene *s, qdot_expr q)
{
    const qdot_state *state = qdot_scene_state_of(s, q);
    qdot_derived *d;
    qdot_expr right;
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    if (state)
        return qdot_rel(s->pool, QDOT_EQ, qdot_mech_jet(s, i, 1), qdot_mech_tidy(s, state->rate));
    d = qdot_derived_get(s);
    if (!qdot_derived_array(s, &d->equation, d->n))
        return QDOT_NIL;
    if (d->equation[i] != QDOT_NIL)
        return d->equation[i];
    right = qdot_add(s->pool, qdot_mech_force(s, q), qdot_constraint_reaction(s, i));
    return d->equation[i] = qdot_rel(s->pool, QDOT_EQ, left_side_of_equation(s, i), right);
}

qdot_expr
qdot_mech_equations(qdot_scene *s)
{
    return qdot_mech_each(s, s->coordinates.n, qdot_mech_equation);
}
