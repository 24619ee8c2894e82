/* bordered.c -- makes the equations with constraints as one linear system for q'' and multipliers. */
#include "sim/form/bordered.h"

#include "base/memory.h"
#include "num/bordered.h"
#include "series/taylor.h"
#include "sim/form/eliminated.h"
#include "sim/model/constraints.h"
#include "sim/model/power-quotient.h"
#include "tape/rounding.h"

/* Write f, M, A and gamma of a plan as a list of expressions; NULL: no memory. */
static qdot_expr *
bordered_equations(const qdot_plan *p, size_t *count)
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
    out = bordered_equations(p, &count);
    status = out ? qdot_pool_check(p->pool) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, count, out, tape);
    if (status == QDOT_OK)
        status = qdot_rounding_show(*tape);
    qdot_free(out);
    return status;
}
