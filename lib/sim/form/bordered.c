/* bordered.c -- the bordered equations, and their series beside another one. */
#include "sim/form/bordered.h"

#include "base/memory.h"
#include "num/bordered.h"
#include "series/taylor.h"
#include "sim/form/derived.h"
#include "sim/form/eliminated.h"
#include "sim/form/guarded.h"
#include "sim/form/motion-series.h"
#include "sim/model/constraints.h"
#include "sim/model/power-quotient.h"

struct qdot_bordered {
    qdot_motion_series *own;
    qdot_guarded guarded; /* that, where it fits */
};

qdot_status
qdot_bordered_new(const qdot_plan *plan, bool shaken, const qdot_ode_series *other,
                  qdot_bordered **bordered)
{
    qdot_bordered *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *bordered = NULL;
    if (!e)
        return QDOT_ENOMEM;
    status = qdot_motion_series_new(plan, shaken, &e->own);
    if (status != QDOT_OK) {
        qdot_bordered_free(e);
        return status;
    }
    qdot_guarded_init(&e->guarded, qdot_motion_series_get(e->own), other, true);
    e->guarded.series.cost = plan->expansions;
    *bordered = e;
    return QDOT_OK;
}

void
qdot_bordered_free(qdot_bordered *e)
{
    if (!e)
        return;
    qdot_motion_series_free(e->own);
    qdot_free(e);
}

const qdot_ode_series *
qdot_bordered_series(const qdot_bordered *e)
{
    return &e->guarded.series;
}

size_t
qdot_bordered_code(const qdot_bordered *e, const char **why)
{
    return qdot_motion_series_code(e->own, why);
}

/* --- its equations ------------------------------------------------------------------- */

/* f, M, A, gamma of a plan; NULL: no memory. */
static qdot_expr *
equations(const qdot_plan *p, size_t *count)
{
    const qdot_constraints *c = p->constraints;
    qdot_expr *out = qdot_calloc(p->n + c->n_masses + c->n_slopes + c->m, sizeof *out);
    size_t n = 0;

    for (size_t i = 0; out && i < p->n; i++)
        out[n++] = qdot_power_quotient(p->pool, p->f[i]);
    for (size_t k = 0; out && k < c->n_masses; k++)
        out[n++] = p->M[c->masses[k].row * p->n + c->masses[k].column];
    for (size_t k = 0; out && k < c->n_slopes; k++)
        out[n++] = c->A[k];
    for (size_t k = 0; out && k < c->m; k++)
        out[n++] = c->gamma[k];
    *count = n;
    return out;
}

qdot_status
qdot_bordered_make(const qdot_plan *p, double tol, qdot_tape **tape)
{
    qdot_expr *out;
    size_t count;
    qdot_status status;

    *tape = NULL;
    if (!(tol >= QDOT_ELIMINATED_TOL) || !p->smooth || !p->method->series || p->indefinite ||
        p->treatment == QDOT_RUN_BAUMGARTE || p->n + p->constraints->m > QDOT_BORDERED_MOST ||
        !qdot_taylor_may_be_code())
        return QDOT_OK;
    out = equations(p, &count);
    status = out ? qdot_pool_check(p->pool) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, count, out, tape);
    qdot_free(out);
    return status;
}
