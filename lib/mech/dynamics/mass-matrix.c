/* mass-matrix.c -- M before T.
 *
 *     T = 1/2 sum M_ij q_i' q_j' + sum b_i q_i' + c
 *     M_ij = sum w dx/dq_i dy/dq_j,   b_i = sum w dx/dq_i dy/dt
 *     c = 1/2 sum w dx/dt dy/dt
 *
 * from the groups of kinematics.c; each entry simplified by itself, T never expanded.
 */
#include "mech/dynamics/mass-matrix.h"

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"

bool
qdot_mass_get(qdot_scene *s)
{
    qdot_kinematics *k = qdot_kinematics_get(s);
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n;
    const qdot_groups *t;
    qdot_expr *M, *b;

    if (!k)
        return false;
    if (d->M)
        return true;
    M = qdot_calloc(n * n + 1, sizeof *M);
    b = qdot_calloc(n + 1, sizeof *b);
    if (!M || !b) {
        qdot_pool_fail(s->pool);
        goto failed;
    }
    t = &k->dx[n];
    for (size_t i = 0; i < n; i++) {
        if (qdot_interrupt_check() != QDOT_OK) {
            qdot_pool_fail(s->pool);
            goto failed;
        }
        for (size_t j = i; j < n; j++)
            M[i * n + j] = M[j * n + i] =
                qdot_kinematics_pair(s, k, &k->dx[i], &k->dy[j], true);
        b[i] = t->n ? qdot_kinematics_pair(s, k, &k->dx[i], &k->dy[n], true) : QDOT_ZERO;
    }
    d->c = t->n ? qdot_mul(s->pool, QDOT_HALF,
                           qdot_kinematics_pair(s, k, t, &k->dy[n], true))
                : QDOT_ZERO;
    if (qdot_pool_failed(s->pool))
        goto failed;
    d->M = M;
    d->b = b;
    return true;
failed:
    qdot_free(M);
    qdot_free(b);
    return false;
}

qdot_expr
qdot_mass_entry(qdot_scene *s, size_t i, size_t j)
{
    return s->derived->M[i * s->derived->n + j];
}

/* Find the derivatives of the entry M_jk of the mass matrix by every coordinate and t on which it depends. */
static qdot_status
find_derivatives_of_entry(qdot_scene *s, size_t j, size_t k)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = s->derived;
    qdot_expr e = d->M[j * d->n + k];
    qdot_status status = QDOT_OK;
    qdot_walk w;

    if (!(qdot_mech_holds(s, e) & (QDOT_HAS_COORD | QDOT_HAS_TIME)))
        return QDOT_OK;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t a = 0; a < w.n && status == QDOT_OK; a++) {
        qdot_expr q = w.at[a];
        qdot_mass_slope x = {(uint32_t)j, (uint32_t)k, 0, QDOT_ZERO};

        if (q != QDOT_T && !qdot_expr_is_coordinate(pool, q))
            continue;
        while (x.i < d->n && s->coordinates.at[x.i] != q)
            x.i++;
        if (x.i == d->n && q != QDOT_T)
            continue;
        x.value = qdot_diff(pool, e, q);
        if (x.value == QDOT_NIL)
            status = qdot_pool_check(pool);
        else if (x.value != QDOT_ZERO)
            status = qdot_vec_push(&d->slopes, x);
    }
    qdot_walk_end(&w);
    return status;
}

bool
qdot_mass_slopes(qdot_scene *s)
{
    qdot_derived *d;

    if (!qdot_mass_get(s))
        return false;
    d = qdot_derived_get(s);
    if (d->slopes_ready)
        return true;
    d->slopes.n = 0;
    for (size_t j = 0; j < d->n; j++)
        for (size_t k = j; k < d->n; k++)
            if (find_derivatives_of_entry(s, j, k) != QDOT_OK) {
                qdot_pool_fail(s->pool);
                return false;
            }
    d->slopes_ready = true;
    return true;
}

qdot_expr
qdot_mass_of_lagrangian(qdot_scene *s, size_t i, size_t j)
{
    qdot_pool *pool = s->pool;
    qdot_expr V, F, second;

    if (qdot_pool_failed(pool)) /* stop early after a failure or Ctrl-C, as there are n^2 entries */
        return QDOT_NIL;
    if (qdot_mech_stated(s)) {
        F = s->lagrangian;
    } else {
        V = qdot_potential_with_velocities(s);
        if (!qdot_mass_get(s) || V == QDOT_NIL)
            return QDOT_NIL;
        if (V == QDOT_ZERO)
            return qdot_mass_entry(s, i, j);
        F = qdot_neg(pool, V);
    }
    second = qdot_diff(pool, qdot_diff(pool, F, qdot_mech_jet(s, i, 1)),
                       qdot_mech_jet(s, j, 1));
    if (second == QDOT_ZERO)
        return qdot_mech_stated(s) ? QDOT_ZERO : qdot_mass_entry(s, i, j);
    if (!qdot_mech_stated(s))
        second = qdot_add(pool, second, qdot_mass_entry(s, i, j));
    return qdot_mech_tidy(s, second);
}

qdot_expr
qdot_mech_mass_matrix(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n;
    qdot_expr *e, M = d->mass_matrix;

    if (M != QDOT_NIL)
        return M;
    if (n == 0)
        return qdot_mech_fail(s, QDOT_EINVAL, "the scene has no coordinates");
    e = qdot_calloc(n * n, sizeof *e);
    if (!e)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++)
            e[i * n + j] = e[j * n + i] = qdot_mass_of_lagrangian(s, i, j);
    M = qdot_matrix(s->pool, (uint32_t)n, (uint32_t)n, e);
    qdot_free(e);
    return d->mass_matrix = M;
}
