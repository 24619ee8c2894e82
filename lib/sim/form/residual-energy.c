/* residual-energy.c -- the energy from the functions in the residual's tree, and from terms outside the tree. */
#include "sim/form/residual-energy.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/dalembert.h"
#include "sim/model/absent.h"

/* Add to each function (or its rate) that of its parent, from the root down: differences become values. */
static void
sum_from_root_down(qdot_pool *pool, const qdot_residual *r, bool rates, qdot_expr *x)
{
    for (size_t f = 0; f < r->functions; f++) {
        qdot_expr d = rates ? qdot_ddt(pool, r->difference[f]) : r->difference[f];

        if (r->parent[f] != UINT32_MAX)
            d = qdot_add(pool, x[r->parent[f]], d);
        x[f] = qdot_hold(pool, d);
    }
}

/* Add up the energy T + V from its terms; x [functions + 2n] is work space. */
static qdot_expr
sum_energy(qdot_scene *scene, const qdot_residual *r, size_t n, const qdot_dalembert_term *terms,
           qdot_expr *x)
{
    qdot_pool *pool = scene->pool;
    qdot_expr *places = x + r->functions, *kinetic = places + n, V;

    sum_from_root_down(pool, r, false, x);
    for (size_t k = 0; k < n; k++)
        places[k] = x[r->weights[k].to];
    V = qdot_mech_dalembert_potential(scene, n, terms, places);
    sum_from_root_down(pool, r, true, x);
    for (size_t k = 0; k < n; k++)
        kinetic[k] = qdot_mul(pool, terms[k].w,
                              qdot_mul(pool, x[r->weights[k].to], x[r->weights[k].from]));
    return qdot_add(pool, qdot_mul(pool, QDOT_HALF, qdot_sum(pool, n, kinetic)), V);
}

qdot_status
qdot_residual_add_energy(qdot_scene *scene, const qdot_plan *p, qdot_residual *r)
{
    qdot_dalembert_term *terms;
    qdot_expr Q, *x;
    size_t n;

    for (size_t f = 0; f < r->functions; f++)
        if (qdot_expr_node(p->pool, r->difference[f])->holds & QDOT_HAS_TIME)
            return QDOT_OK;
    QDOT_TRY(qdot_mech_dalembert(scene, &terms, &n, &Q));
    x = qdot_calloc(r->functions + 2 * n, sizeof *x);
    r->h = x ? qdot_plan_substitute(p, sum_energy(scene, r, n, terms, x)) : QDOT_NIL;
    qdot_free(x);
    qdot_free(terms);
    if (!x)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &r->h, &r->energy));
    r->absent = qdot_malloc(p->n * sizeof *r->absent);
    return r->absent ? qdot_absent_find(r->energy, p->n, r->absent) : QDOT_ENOMEM;
}
