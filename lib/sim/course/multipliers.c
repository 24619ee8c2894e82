/* multipliers.c -- residuals of constraints at every stored point, Lagrange multipliers at the last one. */
#include "sim/course/multipliers.h"

#include <float.h>
#include <math.h>

#include "base/interrupt.h"
#include "sim/model/constraints.h"

void
qdot_multipliers_clear(qdot_multipliers *b)
{
    qdot_free(b->lambda);
    qdot_free(b->error);
    *b = (qdot_multipliers){0};
}

static void
raise_maximum(double *most, size_t row, double x)
{
    if (row != SIZE_MAX && !(x <= *most)) /* also true if x is a NaN, which then stays */
        *most = x;
}

/* Find the Lagrange multipliers at the last point of the run; NaN if the equations have no value there. */
static qdot_status
find_multipliers(qdot_constrained *held, const qdot_trajectory *tr, size_t m,
                 qdot_multipliers *b)
{
    const double *y = tr->y + (tr->count - 1) * tr->n;
    double *a = qdot_calloc(tr->n, sizeof *a);
    qdot_error before = *qdot_last_error();
    qdot_status status;

    b->lambda = qdot_calloc(m, sizeof *b->lambda);
    b->error = qdot_calloc(m, sizeof *b->error);
    for (size_t k = 0; k < m && b->error; k++)
        b->error[k] = NAN;
    if (!a || !b->lambda || !b->error) {
        qdot_free(a);
        return QDOT_ENOMEM;
    }
    status = qdot_constrained_solve(held, tr->t[tr->count - 1], y, a, b->lambda);
    qdot_free(a);
    if (status == QDOT_OK)
        status = qdot_constrained_rescale(held, tr->t[tr->count - 1], y, b->lambda);
    for (size_t k = 0; k < m && status != QDOT_OK; k++)
        b->lambda[k] = NAN;
    if (status == QDOT_ESINGULAR || status == QDOT_EDOMAIN || status == QDOT_EINTR) {
        qdot_fail_again(&before);
        return QDOT_OK;
    }
    return status;
}

/* The constraints in force during a piece of the run; NULL if there are none. */
static qdot_constrained *
constraints_of_piece(qdot_bind *const *binds, const qdot_trajectory *tr, size_t piece)
{
    return qdot_bind_held(binds[piece < tr->pieces.n ? tr->pieces.at[piece].mode : 0]);
}

static qdot_constrained *
constraints_at_end(qdot_bind *const *binds, const qdot_trajectory *tr)
{
    return constraints_of_piece(binds, tr, tr->pieces.n > 0 ? tr->pieces.n - 1 : 0);
}

qdot_status
qdot_multipliers_measure(qdot_bind *const *binds, const qdot_trajectory *tr,
                         qdot_multipliers *b)
{
    qdot_constrained *held = constraints_of_piece(binds, tr, 0);
    size_t piece = 0;

    qdot_multipliers_clear(b);
    b->position = b->velocity = NAN;
    if (!held || tr->count == 0)
        return QDOT_OK;
    for (size_t k = 0; k < tr->count; k++) {
        qdot_constrained_residual r;

        if (k % 1024 == 0 && qdot_interrupt_check() != QDOT_OK) { /* after Ctrl-C only the end of the run is still evaluated */
            b->position = b->velocity = NAN;
            break;
        }
        while (piece + 1 < tr->pieces.n && tr->pieces.at[piece + 1].first <= k)
            held = constraints_of_piece(binds, tr, ++piece);
        r = qdot_constrained_measure(held, tr->t[k], tr->y + k * tr->n);
        raise_maximum(&b->position, r.worst_position, r.position);
        raise_maximum(&b->velocity, r.worst_velocity, r.velocity);
    }
    held = constraints_at_end(binds, tr);
    b->independent = qdot_constrained_rank(held);
    return find_multipliers(held, tr, qdot_constrained_rows(held), b);
}

/* Find the multipliers lambda at y with component i changed by h, into `out`; NaN where undefined. */
static void
find_shifted_multipliers(qdot_constrained *held, double t, double *y, size_t i, double h, double *a,
                         double *out)
{
    qdot_error before = *qdot_last_error();
    double kept = y[i];

    y[i] += h;
    if (qdot_constrained_solve(held, t, y, a, out) != QDOT_OK ||
        qdot_constrained_rescale(held, t, y, out) != QDOT_OK) {
        out[0] = NAN;
        qdot_fail_again(&before);
    }
    y[i] = kept;
}

qdot_status
qdot_multipliers_errors(qdot_bind *const *binds, const qdot_trajectory *tr,
                        const double *difference, qdot_multipliers *b)
{
    qdot_constrained *held = constraints_at_end(binds, tr);
    const size_t n = tr->n, m = held ? qdot_constrained_rows(held) : 0;
    double t, *y, *a, *up, *down;

    if (m == 0 || tr->count == 0 || !b->error || isnan(difference[0]))
        return QDOT_OK;
    y = qdot_calloc(2 * n + 2 * m, sizeof *y);
    if (!y)
        return QDOT_ENOMEM;
    a = y + n;
    up = a + n;
    down = up + m;
    t = tr->t[tr->count - 1];
    for (size_t i = 0; i < n; i++)
        y[i] = tr->y[(tr->count - 1) * n + i];
    for (size_t k = 0; k < m; k++)
        b->error[k] = 4 * DBL_EPSILON * fabs(b->lambda[k]);
    for (size_t i = 0; i < n; i++) {
        double h = 0x1p-20 * fmax(1, fabs(y[i]));

        find_shifted_multipliers(held, t, y, i, h, a, up);
        find_shifted_multipliers(held, t, y, i, -h, a, down);
        for (size_t k = 0; k < m; k++)
            b->error[k] += fabs(up[k] - down[k]) / (2 * h) * difference[i];
    }
    qdot_free(y);
    return QDOT_OK;
}

void
qdot_multipliers_report(const qdot_multipliers *b, const qdot_plan *p, qdot_run_report *r)
{
    r->constraint_drift = r->velocity_drift = NAN;
    if (!p->constraints)
        return;
    r->m = p->m;
    r->multipliers = p->multipliers;
    r->lambda = b->lambda;
    r->lambda_error = b->error;
    r->constraint_drift = isnan(b->position) ? b->velocity : b->position;
    r->velocity_drift = b->velocity;
    r->independent = b->independent < p->n_massless ? 0 : b->independent - p->n_massless;
    r->treatment = p->treatment;
}
