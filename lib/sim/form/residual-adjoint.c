/* residual-adjoint.c -- makes the tapes of a residual whose functions depend on many coordinates each. */
#include "sim/form/residual-adjoint.h"

#include <stdio.h>

#include "base/memory.h"
#include "expr/adjoint.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "series/program.h"
#include "sim/form/residual-energy.h"
#include "tape/rounding.h"

static bool
is_fixed_in_time(const qdot_plan *p, const qdot_residual *r, qdot_expr V)
{
    uint32_t holds = qdot_expr_node(p->pool, V)->holds;

    for (size_t f = 0; f < r->functions; f++)
        holds |= qdot_expr_node(p->pool, r->difference[f])->holds;
    return (holds & QDOT_HAS_TIME) == 0;
}

/* The symbols F_f, and s behind them, of which the adjoint is linear; [functions + 1]. */
static void
name_weights(const qdot_plan *p, const qdot_residual *r, qdot_expr *weight)
{
    char name[32];

    for (size_t f = 0; f <= r->functions; f++) {
        (void)snprintf(name, sizeof name, "force %zu", f);
        weight[f] = qdot_symbol_get(p->pool, QDOT_FORMAL, name);
    }
}

/* The tape `adjoint`; e [functions + 1 + n], in [2n + 1 + functions + 1]: work space. */
static qdot_status
make_adjoint(const qdot_plan *p, qdot_residual *r, qdot_expr V, qdot_expr *e, qdot_expr *in, bool *possible)
{
    const size_t own = 2 * p->n + 1;
    qdot_expr *out = e + r->functions + 1;

    for (size_t i = 0; i < own; i++)
        in[i] = p->inputs[i];
    name_weights(p, r, in + own);
    for (size_t f = 0; f < r->functions; f++)
        e[f] = r->difference[f];
    e[r->functions] = V;
    QDOT_TRY(qdot_adjoint(p->pool, r->functions + 1, e, in + own, p->n, p->inputs, out, possible));
    if (!*possible)
        return QDOT_OK;
    QDOT_TRY(qdot_tape_new(p->pool, own + r->functions + 1, in, p->n, out, &r->adjoint));
    return qdot_rounding_show(r->adjoint);
}

/* The tape `along`, e [functions] is work space. Functions are derived as one list, what they share once. */
static qdot_status
make_differentials(const qdot_plan *p, qdot_residual *r, qdot_expr *e)
{
    const qdot_expr list = qdot_ddt(p->pool, qdot_list(p->pool, (uint32_t)r->functions, r->difference));

    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t f = 0; f < r->functions; f++)
        e[f] = qdot_expr_arg(p->pool, list, (uint32_t)f);
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, r->functions, e, &r->along));
    return qdot_rounding_show(r->along);
}

static qdot_status
make_tapes(qdot_scene *scene, const qdot_plan *p, qdot_residual *r, bool *possible)
{
    qdot_expr V, *e;
    qdot_status status;

    *possible = false;
    QDOT_TRY(qdot_residual_potential(scene, p, r, &V));
    if (!is_fixed_in_time(p, r, V))
        return QDOT_OK;
    e = qdot_calloc(2 * (r->functions + 1) + 3 * p->n + 1, sizeof *e);
    if (!e)
        return QDOT_ENOMEM;
    status = make_adjoint(p, r, V, e, e + r->functions + 1 + p->n, possible);
    if (status == QDOT_OK && *possible)
        status = make_differentials(p, r, e);
    qdot_free(e);
    *possible = *possible && status == QDOT_OK && !qdot_program_hindrance(r->adjoint);
    return status;
}

qdot_status
qdot_residual_adjoint_new(qdot_scene *scene, const qdot_plan *plan, qdot_residual **residual)
{
    qdot_dalembert_term *terms;
    qdot_residual *r = NULL;
    bool possible = false;
    size_t n;
    qdot_status status;

    *residual = NULL;
    QDOT_TRY(qdot_mech_dalembert_terms(scene, &terms, &n));
    status = n > 0 ? qdot_residual_of_terms(plan, n, terms, qdot_mech_dalembert_applied(scene), false, &r) : QDOT_OK;
    qdot_free(terms);
    if (r)
        status = make_tapes(scene, plan, r, &possible);
    if (possible)
        *residual = r;
    else
        qdot_residual_free(r);
    return status;
}
