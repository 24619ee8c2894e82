/* bonds.c -- residuals at every stored point, multipliers at the last. */
#include "sim/bonds.h"

#include <math.h>

#include "base/interrupt.h"
#include "sim/constraints.h"

void
qdot_bonds_clear(qdot_bonds *b)
{
    qdot_free(b->lambda);
    *b = (qdot_bonds){0};
}

static void
widen(double *most, size_t row, double x)
{
    if (row != SIZE_MAX && !(x <= *most)) /* a NaN is replaced, and stays */
        *most = x;
}

/* At the last point; NaN where the equations do not exist there. */
static qdot_status
find_multipliers(qdot_held *held, const qdot_trajectory *tr, size_t m, qdot_bonds *b)
{
    const double *y = tr->y + (tr->count - 1) * tr->n;
    double *a = qdot_calloc(tr->n, sizeof *a);
    qdot_error before = *qdot_last_error();
    qdot_status status;

    b->lambda = qdot_calloc(m, sizeof *b->lambda);
    if (!a || !b->lambda) {
        qdot_free(a);
        return QDOT_ENOMEM;
    }
    status = qdot_held_solve(held, tr->t[tr->count - 1], y, a, b->lambda);
    qdot_free(a);
    for (size_t k = 0; k < m && status != QDOT_OK; k++)
        b->lambda[k] = NAN;
    if (status == QDOT_ESINGULAR || status == QDOT_EDOMAIN) {
        qdot_fail_again(&before);
        return QDOT_OK;
    }
    return status;
}

qdot_status
qdot_bonds_measure(qdot_bind *bind, const qdot_trajectory *tr, qdot_bonds *b)
{
    qdot_held *held = qdot_bind_held(bind);

    qdot_bonds_clear(b);
    b->position = b->velocity = NAN;
    if (!held || tr->count == 0)
        return QDOT_OK;
    for (size_t k = 0; k < tr->count; k++) {
        qdot_held_residual r;

        if (k % 1024 == 0)
            QDOT_TRY(qdot_interrupt_check());
        r = qdot_held_measure(held, tr->t[k], tr->y + k * tr->n);
        widen(&b->position, r.worst_position, r.position);
        widen(&b->velocity, r.worst_velocity, r.velocity);
    }
    b->independent = qdot_held_rank(held);
    return find_multipliers(held, tr, qdot_held_rows(held), b);
}

void
qdot_bonds_report(const qdot_bonds *b, const qdot_plan *p, qdot_run_report *r)
{
    r->constraint_drift = r->velocity_drift = NAN;
    if (!p->constraints)
        return;
    r->m = p->constraints->m;
    r->multipliers = p->inputs + 3 * p->n + 1;
    r->lambda = b->lambda;
    r->constraint_drift = isnan(b->position) ? b->velocity : b->position;
    r->velocity_drift = b->velocity;
    r->independent = b->independent;
    r->treatment = p->treatment;
}
