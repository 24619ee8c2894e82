/* tree-series.c -- computes each Taylor order of q'' by one sweep up the tree of functions and one down. */
#include "sim/form/tree-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/cholesky.h"
#include "series/taylor.h"
#include "sim/form/blocks.h"
#include "sim/form/expansion.h"
#include "sim/form/residual-sweeps.h"
#include "tape/shake.h"

enum { most_order = 44, lanes = 8 };

/* M counts as singular if a pivot, relative to its mass, is smaller: four digits are lost then. */
static const double least_pivot = 1e-4;

struct qdot_tree_series {
    const qdot_plan *plan;
    const qdot_residual *residual;
    qdot_residual_sweeps *tree;
    qdot_expansion places,
        forces;     /* the series of the forces; without program if there are none */
    double *weight; /* [n_weights] the weights w in doubles */
    qdot_ode_series series;
    double unit, force_scale; /* unit of time; its square, by which forces are multiplied */
    const double *
        *applied; /* [n] Taylor coefficients of velocity-dependent Q_i; NULL: zero, or in `places` */
    const double **slope;   /* [n_slopes] Taylor coefficients of the derivatives dd_f/dq_i */
    double *x, *F;          /* [functions] Taylor coefficients of x'' and of the forces F, at the present order */
    size_t eliminated;      /* number of times that M has been eliminated so far */
    double *R;              /* [n] right-hand sides of the equations */
};

/* --- along the tree --------------------------------------------------------------------- */

/* Evaluate the Taylor coefficients of order k of the forces that depend on velocities. */
static void
evaluate_forces(qdot_tree_series *s, int k)
{
    const qdot_expansion *from = &s->places, *to = &s->forces;

    if (!to->taylor)
        return;
    for (size_t i = 0; i < 2 * s->plan->n; i++)
        to->q[i * to->stride + (size_t)k] = from->q[i * from->stride + (size_t)k];
    qdot_taylor_order(to->taylor, k);
    for (size_t i = 0; i < s->plan->n; i++)
        s->R[i] = s->applied[i] ? s->force_scale * s->applied[i][k] : 0;
}

/* Store the Taylor coefficients of q up to order m, and of v up to order m - 1. */
static void
store_coefficients(const qdot_tree_series *s, int m)
{
    qdot_residual_sweeps_rows(s->tree, m, 1 / s->unit, s->places.q, s->places.v,
                              s->places.stride);
}

/* Compute the Taylor coefficients of order m >= 2 of the coordinates q. */
static void
compute_coordinates_order(qdot_tree_series *s, int m)
{
    evaluate_forces(s, m - 2);
    qdot_residual_sweeps_order(s->tree, m, s->force_scale,
                               s->forces.taylor ? s->R : NULL);
    if (s->forces.taylor)
        store_coefficients(s, m);
}

/* Factor the mass matrix M by Cholesky's method; fails if M is singular. */
static qdot_status
factor_mass_matrix(qdot_tree_series *s)
{
    const size_t n = s->plan->n;
    double *M = qdot_calloc(n * n, sizeof *M);
    size_t row;
    qdot_status status;

    if (!M)
        return QDOT_ENOMEM;
    qdot_residual_masses(s->residual, n, s->weight, s->slope, s->x, s->F, M);
    status = qdot_cholesky_factor(M, n, NULL, &row);
    qdot_free(M);
    return status == QDOT_ESINGULAR ? qdot_blocks_singular(s->plan, s->plan->blocks, row)
                                    : status;
}

/* Set the orders 0 and 1 of the Taylor series, and eliminate M along the tree. */
static qdot_status
begin_elimination(qdot_tree_series *s, const double *y)
{
    double lost;
    bool good;

    qdot_taylor_order(s->places.taylor, 0);
    for (size_t i = 0; i < s->plan->n; i++)
        s->R[i] = s->unit * y[s->plan->n + i];
    good = qdot_residual_sweeps_begin(s->tree, s->places.taylor, s->R, &lost);
    s->eliminated++;
    if (good && lost >= least_pivot)
        return QDOT_OK;
    QDOT_TRY(factor_mass_matrix(s));
    return good
               ? QDOT_OK
               : qdot_fail(QDOT_ESINGULAR, "the mass matrix is singular within rounding");
}

static qdot_status
begin_tree_series(double t, const double *y, double unit, void *user)
{
    qdot_tree_series *s = user;
    size_t n = s->plan->n;

    s->unit = unit;
    s->force_scale = unit * unit;
    qdot_expansion_begin(&s->places, t, y, unit);
    if (s->forces.taylor)
        qdot_expansion_begin(&s->forces, t, y, unit);
    QDOT_TRY(begin_elimination(s, y));
    compute_coordinates_order(s, 2);
    store_coefficients(s, 2);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(s->places.v[i * s->places.stride + 1]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             s->plan->names[i]);
    return QDOT_OK;
}

static qdot_status
extend_tree_series(int p, void *user)
{
    qdot_tree_series *s = user;

    for (int m = 3; m <= p + 1; m++)
        compute_coordinates_order(s, m);
    store_coefficients(s, p + 1);
    return QDOT_OK;
}

/* Find a step so short that the series' last terms are negligible; forces have two orders less than q. */
static double
find_negligible_step(int p, double step, double least, void *user)
{
    const qdot_tree_series *s = user;

    step = qdot_taylor_near(s->places.taylor, p - 2, step, least);
    return s->forces.taylor ? qdot_taylor_near(s->forces.taylor, p - 2, step, least) : step;
}

/* --- making the series ------------------------------------------------------------------ */

static qdot_status
make_series_of_tapes(qdot_tree_series *s, bool shaken)
{
    const qdot_residual *r = s->residual;
    const size_t n = s->plan->n;

    QDOT_TRY(qdot_taylor_of_program(&r->of_places, shaken, most_order, &s->places.taylor));
    s->places = qdot_expansion_of(s->places.taylor, n);
    if (!r->forces)
        return QDOT_OK;
    QDOT_TRY(qdot_taylor_of_program(&r->of_forces, shaken, most_order, &s->forces.taylor));
    s->forces = qdot_expansion_of(s->forces.taylor, n);
    return QDOT_OK;
}

static qdot_status
make_tree_series(qdot_tree_series *s, bool shaken)
{
    const qdot_plan *p = s->plan;
    const qdot_residual *r = s->residual;

    QDOT_TRY(make_series_of_tapes(s, shaken));
    s->weight = qdot_calloc(r->n_weights, sizeof *s->weight);
    s->x = qdot_calloc(r->functions, sizeof *s->x);
    s->F = qdot_calloc(r->functions, sizeof *s->F);
    s->slope = qdot_calloc(r->n_slopes + 1, sizeof *s->slope);
    s->R = qdot_calloc(p->n + lanes, sizeof *s->R);
    s->applied = qdot_calloc(p->n, sizeof *s->applied);
    if (!s->weight || !s->x || !s->F || !s->slope || !s->R || !s->applied)
        return QDOT_ENOMEM;
    for (size_t w = 0; w < r->n_weights; w++)
        s->weight[w] = shaken ? qdot_shake_double(r->weights[w].w, r->weights[w].side)
                              : r->weights[w].w;
    for (size_t j = 0; j < r->n_slopes; j++)
        s->slope[j] = qdot_taylor_output(s->places.taylor, r->slopes[j].output);
    for (size_t i = 0; i < p->n; i++)
        if (r->force[i] != UINT32_MAX && r->force[i] & QDOT_RESIDUAL_FORCES)
            s->applied[i] =
                qdot_taylor_output(s->forces.taylor, r->force[i] ^ QDOT_RESIDUAL_FORCES);
    QDOT_TRY(qdot_residual_sweeps_new(r, p->n, s->places.taylor, s->weight, &s->tree));
    if (!s->tree)
        return QDOT_OK;
    s->series = (qdot_ode_series){.most = most_order - 4,
                                  .x = s->places.q,
                                  .stride = s->places.stride,
                                  .checked = p->n,
                                  .cost = p->expansions,
                                  .begin = begin_tree_series,
                                  .extend = extend_tree_series,
                                  .user = s};
    if (qdot_taylor_may_hide(s->places.taylor) ||
        (s->forces.taylor && qdot_taylor_may_hide(s->forces.taylor)))
        s->series.near = find_negligible_step;
    return QDOT_OK;
}

qdot_status
qdot_tree_series_new(const qdot_plan *plan, const qdot_residual *residual, bool shaken,
                     qdot_tree_series **series)
{
    qdot_tree_series *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *series = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->residual = residual;
    status = make_tree_series(s, shaken);
    if (status == QDOT_OK && s->tree)
        *series = s;
    else
        qdot_tree_series_free(s);
    return status;
}

void
qdot_tree_series_free(qdot_tree_series *s)
{
    if (!s)
        return;
    qdot_taylor_free(s->places.taylor);
    qdot_taylor_free(s->forces.taylor);
    qdot_residual_sweeps_free(s->tree);
    qdot_free(s->weight);
    qdot_free(s->applied);
    qdot_free(s->slope);
    qdot_free(s->x);
    qdot_free(s->F);
    qdot_free(s->R);
    qdot_free(s);
}

const qdot_ode_series *
qdot_tree_series_get(const qdot_tree_series *s)
{
    return &s->series;
}

qdot_work
qdot_tree_series_work(const qdot_tree_series *s)
{
    const qdot_taylor *forces = s->forces.taylor;
    qdot_work w = {.coordinates = (double)s->plan->n,
                   .calls = (double)qdot_tape_calls(s->residual->places),
                   .nodes = (double)qdot_residual_sweeps_nodes(s->tree)};

    qdot_residual_sweeps_count(s->tree, &w.vectors, &w.products, &w.begun);
    if (forces) {
        w.length = (double)qdot_taylor_length(forces);
        w.convolutions = qdot_taylor_convolutions(forces);
    }
    return w;
}

double
qdot_tree_series_convolutions(const qdot_tree_series *s)
{
    return qdot_taylor_convolutions(s->places.taylor) +
           (s->forces.taylor ? qdot_taylor_convolutions(s->forces.taylor) : 0) +
           (double)s->residual->n_slopes;
}

bool
qdot_tree_series_is_path(const qdot_tree_series *s)
{
    return qdot_residual_sweeps_is_path(s->tree);
}

size_t
qdot_tree_series_eliminated(const qdot_tree_series *s)
{
    return s->eliminated;
}
