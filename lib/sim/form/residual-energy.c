/* residual-energy.c -- energy along the residual's tree, and what does not stand in it. */
#include "sim/form/residual-energy.h"

#include <math.h>

#include "expr/calculus.h"
#include "mech/dynamics/dalembert.h"
#include "series/lanes.h"

/* Of |h|: what a change by a coordinate that stands in it is beyond. */
static const double noise = 1e-11;

/* Each function, or its rate, by that of its parent. */
static void
sum_down(qdot_pool *pool, const qdot_residual *r, bool rates, qdot_expr *x)
{
    for (size_t f = 0; f < r->functions; f++) {
        qdot_expr d = rates ? qdot_ddt(pool, r->difference[f]) : r->difference[f];

        if (r->parent[f] != UINT32_MAX)
            d = qdot_add(pool, x[r->parent[f]], d);
        x[f] = qdot_hold(pool, d);
    }
}

/* T + V from its terms; x [functions + 2n] is work space. */
static qdot_expr
add_up(qdot_scene *scene, const qdot_residual *r, size_t n, const qdot_dalembert_term *terms,
       qdot_expr *x)
{
    qdot_pool *pool = scene->pool;
    qdot_expr *places = x + r->functions, *kinetic = places + n, V;

    sum_down(pool, r, false, x);
    for (size_t k = 0; k < n; k++)
        places[k] = x[r->weights[k].to];
    V = qdot_mech_dalembert_potential(scene, n, terms, places);
    sum_down(pool, r, true, x);
    for (size_t k = 0; k < n; k++)
        kinetic[k] = qdot_mul(pool, terms[k].w,
                              qdot_mul(pool, x[r->weights[k].to], x[r->weights[k].from]));
    return qdot_add(pool, qdot_mul(pool, QDOT_HALF, qdot_sum(pool, n, kinetic)), V);
}

/* Numbers without a pattern in (0.3, 1.7), where most domains are. */
static double
place(size_t i)
{
    return 0.3 + 1.4 * fmod(0.5545497 * (double)(i + 1), 1);
}

/* h with coordinate i moved, and with none for i = n, in lanes of eight i; h [n + 1]. */
static void
move_each(const qdot_residual *r, size_t n, size_t round, double *h, double *in, double *work)
{
    double out[QDOT_LANES];

    for (size_t j = 0; j < (2 * n + 1) * QDOT_LANES; j++)
        in[j] = place(j / QDOT_LANES + 7 * round);
    for (size_t i = 0; i <= n; i += QDOT_LANES) {
        for (size_t l = 0; l < QDOT_LANES && i + l < n; l++)
            in[(i + l) * QDOT_LANES + l] = place(i + l + 7 * round + 3);
        qdot_lanes_eval(r->energy, in, out, work);
        for (size_t l = 0; l < QDOT_LANES && i + l <= n; l++) {
            h[i + l] = out[l];
            in[(i + l) * QDOT_LANES + l] = place(i + l + 7 * round);
        }
    }
}

/* Into r->absent. */
static qdot_status
find_absent(qdot_residual *r, size_t n)
{
    bool *absent = r->absent = qdot_malloc(n * sizeof *r->absent);
    double *in = qdot_malloc(QDOT_LANES * (2 * n + 1) * sizeof *in);
    double *work = qdot_malloc(QDOT_LANES * (qdot_tape_work(r->energy) + 1) * sizeof *work);
    double *h = qdot_malloc((n + 1) * sizeof *h);
    qdot_status status = absent && in && work && h ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n && absent; i++)
        absent[i] = true;
    for (size_t round = 0; round < 2 && status == QDOT_OK; round++) {
        move_each(r, n, round, h, in, work);
        for (size_t i = 0; i < n; i++)
            absent[i] = absent[i] && !(fabs(h[i] - h[n]) > noise * (1 + fabs(h[n])));
    }
    qdot_free(in);
    qdot_free(work);
    qdot_free(h);
    return status;
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
    r->h = x ? qdot_plan_substitute(p, add_up(scene, r, n, terms, x)) : QDOT_NIL;
    qdot_free(x);
    qdot_free(terms);
    if (!x)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &r->h, &r->energy));
    return find_absent(r, p->n);
}
