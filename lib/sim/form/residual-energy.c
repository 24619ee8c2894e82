/* residual-energy.c -- the energy from the functions in the residual's tree, and from terms outside the tree. */
#include "sim/form/residual-energy.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/dalembert.h"
#include "sim/model/absent.h"
#include "sim/model/switch.h"

/* Add to each function (or its rate) that of its parent, from the root down: differences become values. */
static void
sum_from_root_down(qdot_pool *pool, const qdot_residual *r, bool rates, qdot_expr *x)
{
    /* as one list, so that what functions share is derived once */
    const qdot_expr all = qdot_list(pool, (uint32_t)r->functions, r->difference), list = rates ? qdot_ddt(pool, all) : all;

    for (size_t f = 0; f < r->functions && list != QDOT_NIL; f++) {
        qdot_expr d = qdot_expr_arg(pool, list, (uint32_t)f);

        if (r->parent[f] != UINT32_MAX)
            d = qdot_add(pool, x[r->parent[f]], d);
        x[f] = qdot_hold(pool, d);
    }
}

/* V with the functions' values, summed up into x [functions + n]. */
static qdot_expr
sum_potential(qdot_scene *scene, const qdot_residual *r, size_t n, const qdot_dalembert_term *terms, qdot_expr *x)
{
    qdot_expr *places = x + r->functions;

    sum_from_root_down(scene->pool, r, false, x);
    for (size_t k = 0; k < n; k++)
        places[k] = x[r->weights[k].to];
    return qdot_mech_dalembert_potential(scene, n, terms, places);
}

/* Add up the energy T + V from its terms; x [functions + n] is work space. */
static qdot_expr
sum_energy(qdot_scene *scene, const qdot_residual *r, size_t n, const qdot_dalembert_term *terms,
           qdot_expr *x)
{
    qdot_pool *pool = scene->pool;
    const qdot_expr V = sum_potential(scene, r, n, terms, x);
    qdot_expr *kinetic = x + r->functions;

    sum_from_root_down(pool, r, true, x);
    for (size_t k = 0; k < n; k++)
        kinetic[k] = qdot_mul(pool, terms[k].w,
                              qdot_mul(pool, x[r->weights[k].to], x[r->weights[k].from]));
    return qdot_add(pool, qdot_mul(pool, QDOT_HALF, qdot_sum(pool, n, kinetic)), V);
}

/* A sum over the terms of the scene by the functions of its residual, parameter values put in. */
static qdot_status
sum_by_functions(qdot_scene *scene, const qdot_plan *p, const qdot_residual *r,
                 qdot_expr (*sum)(qdot_scene *scene, const qdot_residual *r, size_t n, const qdot_dalembert_term *terms,
                                  qdot_expr *x),
                 qdot_expr *e)
{
    qdot_dalembert_term *terms;
    qdot_expr *x;
    size_t n;

    *e = QDOT_NIL;
    QDOT_TRY(qdot_mech_dalembert_terms(scene, &terms, &n));
    x = qdot_calloc(r->functions + n + 1, sizeof *x);
    if (x)
        *e = qdot_plan_substitute(p, sum(scene, r, n, terms, x));
    qdot_free(x);
    qdot_free(terms);
    return x ? qdot_pool_check(p->pool) : QDOT_ENOMEM;
}

qdot_status
qdot_residual_potential(qdot_scene *scene, const qdot_plan *p, const qdot_residual *r, qdot_expr *V)
{
    return sum_by_functions(scene, p, r, sum_potential, V);
}

qdot_status
qdot_residual_add_energy(qdot_scene *scene, const qdot_plan *p, qdot_residual *r)
{
    for (size_t f = 0; f < r->functions; f++)
        if (qdot_expr_node(p->pool, r->difference[f])->holds & QDOT_HAS_TIME)
            return QDOT_OK;
    QDOT_TRY(sum_by_functions(scene, p, r, sum_energy, &r->h));
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &r->h, &r->energy));
    r->absent = qdot_calloc(p->n, sizeof *r->absent);
    if (!r->absent)
        return QDOT_ENOMEM;
    return r->adjoint && p->n >= QDOT_MANY_COORDINATES ? QDOT_OK : qdot_absent_find(r->energy, p->n, r->absent);
}
