/* constrained-implicit.c -- the equations under constraints for implicit methods: residuals and
 * their derivatives. */
#include <string.h>

#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"
#include "tape/derivative.h"

/* Whether constraint k is used as a condition on velocities; the others are used as conditions on
 * accelerations. */
static bool
is_velocity_constraint(const qdot_constrained *h, size_t k)
{
    return h->plan->treatment == QDOT_RUN_PROJECT &&
           h->c->rows[k].kind != QDOT_ACCELERATION;
}

/* Which rows are not redundant; the multipliers of others are 0. Once chosen they stay while they are
 * as many, since multipliers are predicted from step to step. */
static void
find_independent_rows(qdot_constrained *h)
{
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;
    size_t count = 0;

    for (size_t k = 0; k < s->m; k++)
        count += h->used[k];
    for (size_t j = 0; j < s->m && count != s->rank; j++)
        h->used[s->rank < s->m ? s->pivot[j] : j] = j < s->rank;
}

qdot_status
qdot_constrained_implicit(qdot_constrained *h, double t, const double *y, const double *a,
                          const double *z, double *r)
{
    const qdot_constraints *c = h->c;
    const size_t n = h->plan->n;
    const double *out;

    qdot_constrained_load(h, t, y);
    if (h->plan->treatment == QDOT_RUN_BAUMGARTE)
        qdot_constrained_positions(h);
    qdot_constrained_velocities(h);
    qdot_tape_eval(qdot_constrained_tape(h->equations, h->plan->tape), h->in, h->out,
                   h->work);
    memcpy(r, h->out, n * sizeof *r);
    out = h->out + n;
    for (size_t e = 0; e < c->n_masses; e++, out++) {
        const size_t i = c->masses[e].row, j = c->masses[e].column;

        r[i] -= *out * a[j];
        r[j] -= i == j ? 0 : *out * a[i];
    }
    memcpy(r + n, out + c->n_slopes, c->m * sizeof *r);
    if (h->plan->treatment == QDOT_RUN_BAUMGARTE)
        qdot_constrained_damp(h, r + n);
    for (size_t e = 0; e < c->n_slopes; e++, out++) {
        const size_t k = c->slopes[e].row, i = c->slopes[e].column;

        r[i] += *out * z[k];
        r[n + k] -= *out * a[i];
    }
    for (size_t k = 0; k < c->m; k++)
        r[n + k] = !h->used[k] ? -z[k] : is_velocity_constraint(h, k) ? h->w[k] : r[n + k];
    return QDOT_OK;
}

/* The derivatives of the constraint equations that are conditions on velocities, and rows for
 * redundant ones. */
static void
write_constraint_rows(qdot_constrained *h, double *dq, double *dv, double *M)
{
    const size_t n = h->plan->n, m = h->c->m, columns = 2 * n + 1, all = n + m;
    const double *from = h->slopes;

    qdot_derivative_eval(qdot_constrained_tape(h->velocities, h->c->velocities), h->in, 0,
                         columns, h->out, h->slopes, h->slopes_work);
    for (size_t k = 0; k < m; k++) {
        const size_t at = (n + k) * all;

        if (is_velocity_constraint(h, k) || !h->used[k]) {
            memset(M + at, 0, n * sizeof *M);
            memset(dq + at, 0, n * sizeof *dq);
            memset(dv + at, 0, n * sizeof *dv);
        }
        if (!h->used[k]) {
            dv[at + n + k] = -1;
        } else if (is_velocity_constraint(h, k)) {
            memcpy(dq + at, from, n * sizeof *dq);
            memcpy(dv + at, from + n, n * sizeof *dv);
        }
        if (h->c->rows[k].kind != QDOT_ACCELERATION)
            from += columns;
    }
}

qdot_status
qdot_constrained_implicit_slopes(qdot_constrained *h, double t, const double *y,
                                 double *z, double *dq, double *dv, double *M)
{
    const size_t n = h->plan->n, m = h->c->m, columns = 2 * n + 1, all = n + m;
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;

    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, h->a + n));
    find_independent_rows(h);
    memcpy(z, h->a + n, m * sizeof *z);
    qdot_constrained_gains(h);
    memset(dq, 0, all * all * sizeof *dq);
    memset(dv, 0, all * all * sizeof *dv);
    memset(M, 0, all * all * sizeof *M);
    for (size_t i = 0; i < all; i++) {
        memcpy(dq + i * all, h->gains + i * columns, n * sizeof *dq);
        memcpy(dv + i * all, h->gains + i * columns + n, n * sizeof *dv);
        memcpy(M + i * all, i < n ? s->M + i * n : s->A + (i - n) * n, n * sizeof *M);
    }
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < n; i++)
            dv[i * all + n + k] = s->A[k * n + i];
    write_constraint_rows(h, dq, dv, M);
    return QDOT_OK;
}
