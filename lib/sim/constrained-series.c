/* constrained-series.c -- order by order: residuals of the constraints ahead, tape, solve, correct. */
#include "sim/constrained-series.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "num/series.h"
#include "sim/constraints.h"
#include "sim/constrained.h"
#include "tape/taylor.h"

enum { most_order = 44 };

/* Orders found by a residual-corrected solve: an error of the inverse is the same at every
 * order of a step, and so a drift of the energy instead of noise. With 0 that of the
 * Cartesian pendulum grows as t; from 3 on as the square root of t. */
enum { refined = 3 };

/* Constraints are nearly dependent where less than this is left of their best. */
static const double nearly = 0.3;

/* An entry of M or A that moves: `to`, a place in the equations, gains sum series_j of_{k
 * - j}. */
typedef struct {
    size_t to;
    const double *series, *of;
} coupling;

/* The constraints of a kind. */
typedef struct {
    qdot_taylor *taylor;
    double *newest, *other, *t; /* rows of its inputs: by its kind, see constraints.h */
    double *velocity;           /* of an acceleration constraint */
    size_t stride;
} kind_series;

struct qdot_constrained_series {
    const qdot_plan *plan;
    const qdot_constraints *c;
    const qdot_series_kernels *kernels;
    qdot_taylor *motion; /* f, M */
    kind_series kinds[3];
    qdot_saddle saddle;
    double best;  /* its best quality so far */
    double *weak; /* [m + n] scratch */
    qdot_ode_series series;
    double unit;
    double *q, *v, *t; /* inputs' rows of `motion`, `stride` apart */
    size_t stride;
    double *a, *lambda;  /* [n x stride], [m x stride] series of q'', -lambda */
    double *newest;      /* [n] */
    const double **f;    /* [n] series */
    const double **M;    /* [n_masses] */
    const double **A;    /* [n_slopes] */
    const double **rows; /* [m] series of the constraints */
    coupling *couplings;
    size_t n_couplings;
};

/* --- one order ---------------------------------------------------------------------- */

/* Coefficient `order` of coordinate or velocity rows into those of another tape. */
static void
copy_order(const double *from, size_t stride, double *to, size_t to_stride, size_t n,
           int order)
{
    for (size_t i = 0; i < n; i++)
        to[i * to_stride + (size_t)order] = from[i * stride + (size_t)order];
}

static void
clear_order(double *to, size_t stride, size_t n, int order)
{
    for (size_t i = 0; i < n; i++)
        to[i * stride + (size_t)order] = 0;
}

/* The constraints with their newest coefficient 0, as far ahead as their kind is. */
static void
look_ahead(qdot_constrained_series *e, int k)
{
    const size_t n = e->plan->n;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;
    kind_series *a = e->kinds + QDOT_ACCELERATION;

    if (h->taylor) {
        clear_order(h->newest, h->stride, n, k + 2);
        qdot_taylor_order(h->taylor, k + 2);
    }
    if (v->taylor) {
        copy_order(e->q, e->stride, v->other, v->stride, n, k + 1);
        clear_order(v->newest, v->stride, n, k + 1);
        qdot_taylor_order(v->taylor, k + 1);
    }
    if (a->taylor) {
        copy_order(e->q, e->stride, a->other, a->stride, n, k);
        copy_order(e->v, e->stride, a->velocity, a->stride, n, k);
        clear_order(a->newest, a->stride, n, k);
        qdot_taylor_order(a->taylor, k);
    }
}

/* What row r of the constraints asks of A_0 a_k. */
static double
wanted(const qdot_constrained_series *e, size_t r, int k)
{
    const double *f = e->rows[r], one = (k + 1) / e->unit, two = one * (k + 2) / e->unit;
    const double damping =
        e->plan->treatment == QDOT_RUN_BAUMGARTE ? QDOT_CONSTRAINED_RATE : 0;

    switch (e->c->rows[r].kind) {
    case QDOT_HOLONOMIC:
        return -two * f[k + 2] - damping * (2 * one * f[k + 1] + damping * f[k]);
    case QDOT_VELOCITY: return -one * f[k + 1] - damping * f[k];
    case QDOT_ACCELERATION: break;
    }
    return -f[k];
}

/* Coefficient k of accelerations and multipliers is known: what follows from it. */
static void
bring_up_to_date(qdot_constrained_series *e, int k)
{
    const size_t n = e->plan->n;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;
    kind_series *a = e->kinds + QDOT_ACCELERATION;

    for (size_t i = 0; i < n; i++) {
        e->newest[i] = e->unit * e->a[i * e->stride + (size_t)k] / (k + 1);
        e->v[i * e->stride + (size_t)k + 1] = e->newest[i];
    }
    if (v->taylor)
        qdot_taylor_correct(v->taylor, k + 1, n, e->newest);
    for (size_t i = 0; i < n; i++) {
        e->newest[i] = e->unit * e->newest[i] / (k + 2);
        e->q[i * e->stride + (size_t)k + 2] = e->newest[i];
    }
    if (h->taylor)
        qdot_taylor_correct(h->taylor, k + 2, n, e->newest);
    if (!a->taylor)
        return;
    if (k == 0) { /* order 0 is not affine */
        copy_order(e->a, e->stride, a->newest, a->stride, n, 0);
        qdot_taylor_order(a->taylor, 0);
        return;
    }
    for (size_t i = 0; i < n; i++)
        e->newest[i] = e->a[i * e->stride + (size_t)k];
    qdot_taylor_correct(a->taylor, k, n, e->newest);
}

static qdot_status
factor(qdot_constrained_series *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->plan->n;
    qdot_saddle *s = &e->saddle;

    for (size_t k = 0; k < c->n_masses; k++) {
        size_t i = c->masses[k].row, j = c->masses[k].column;

        s->M[i * n + j] = s->M[j * n + i] = e->M[k][0];
    }
    for (size_t k = 0; k < c->n_slopes; k++)
        s->A[c->slopes[k].row * n + c->slopes[k].column] = e->A[k][0];
    return qdot_constrained_factor(e->plan, s);
}

/* Order k, orders below being there. */
static qdot_status
order(qdot_constrained_series *e, int k)
{
    const size_t n = e->plan->n, m = e->c->m;
    double *x = e->saddle.x;

    look_ahead(e, k);
    qdot_taylor_order(e->motion, k);
    if (k == 0)
        QDOT_TRY(factor(e));
    for (size_t i = 0; i < n; i++)
        x[i] = e->f[i][k];
    for (size_t r = 0; r < m; r++)
        x[n + r] = wanted(e, r, k);
    for (size_t j = 0; k > 0 && j < e->n_couplings; j++) {
        const coupling *w = e->couplings + j;

        x[w->to] -= e->kernels->dot[k](w->series + 1, w->of + k - 1);
    }
    if (k <= refined)
        qdot_saddle_solve_refined(&e->saddle);
    else
        qdot_saddle_apply(&e->saddle);
    for (size_t i = 0; i < n; i++)
        e->a[i * e->stride + (size_t)k] = x[i];
    for (size_t r = 0; r < m; r++)
        e->lambda[r * e->stride + (size_t)k] = x[n + r];
    bring_up_to_date(e, k);
    return QDOT_OK;
}

/* Order 0 of all inputs, and 1 of the coordinates, at (t, y). */
static void
load(qdot_constrained_series *e, double t, const double *y)
{
    const size_t n = e->plan->n;

    for (size_t i = 0; i < n; i++) {
        e->q[i * e->stride] = y[i];
        e->q[i * e->stride + 1] = e->unit * y[n + i];
        e->v[i * e->stride] = y[n + i];
    }
    e->t[0] = t;
    e->t[1] = e->unit;
    qdot_taylor_draw(e->motion, t);
    for (int kind = 0; kind < 3; kind++) {
        kind_series *s = e->kinds + kind;

        if (!s->taylor)
            continue;
        s->t[0] = t;
        s->t[1] = e->unit;
        qdot_taylor_draw(s->taylor, t);
    }
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_constrained_series *e = user;
    const size_t n = e->plan->n;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;

    e->unit = unit;
    load(e, t, y);
    for (int k = 0; h->taylor && k < 2; k++) {
        copy_order(e->q, e->stride, h->newest, h->stride, n, k);
        qdot_taylor_order(h->taylor, k);
    }
    if (v->taylor) {
        copy_order(e->q, e->stride, v->other, v->stride, n, 0);
        copy_order(e->v, e->stride, v->newest, v->stride, n, 0);
        qdot_taylor_order(v->taylor, 0);
    }
    QDOT_TRY(order(e, 0));
    for (size_t i = 0; i < n; i++)
        if (!isfinite(e->a[i * e->stride]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             e->plan->names[i]);
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    qdot_constrained_series *e = user;

    qdot_saddle_prepare(&e->saddle);
    for (int k = 1; k < p; k++)
        QDOT_TRY(order(e, k));
    return QDOT_OK;
}

/* Near a place where the constraints are dependent a direction of the accelerations is
 * found by dividing rounding by what is left of their independence, twice over: the slope
 * of the constraints is as uncertain. Each order adds one more such division, which the
 * length of the step balances. */
static double
noise(void *user)
{
    qdot_constrained_series *e = user;
    double left;

    e->best = fmax(e->best, e->saddle.quality);
    left = e->saddle.quality / e->best;
    return left < nearly ? fmin(1e-9, 100 * DBL_EPSILON / (left * left)) : 0;
}

/* The weakest combination of rows, along its own direction, is a scalar series that passes
 * 0 where they are dependent; its first root, from the lowest orders. */
static double
ahead(void *user)
{
    qdot_constrained_series *e = user;
    const qdot_constraints *c = e->c;
    double sigma[4] = {0}, s, *row = e->weak, *column = e->weak + c->m;

    if (e->saddle.rank == 0)
        return 0;
    qdot_saddle_weakest(&e->saddle, row, column);
    for (size_t k = 0; k < c->n_slopes; k++)
        for (int j = 0; j < 4; j++)
            sigma[j] += row[c->slopes[k].row] * column[c->slopes[k].column] * e->A[k][j];
    s = -sigma[0] / sigma[1];
    for (int k = 0; k < 20; k++) {
        double f = sigma[0] + s * (sigma[1] + s * (sigma[2] + s * sigma[3]));

        s -= f / (sigma[1] + s * (2 * sigma[2] + s * 3 * sigma[3]));
    }
    return s > 0 && isfinite(s) ? s * fabs(e->unit) : 0;
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
make_kind(qdot_constrained_series *e, qdot_constraint_kind kind, bool shaken)
{
    kind_series *s = e->kinds + kind;
    const size_t n = e->plan->n, first = kind == QDOT_ACCELERATION ? n : 0;

    if (!e->c->series[kind])
        return QDOT_OK;
    QDOT_TRY(qdot_taylor_new_shaken(e->c->series[kind], shaken, most_order, &s->taylor));
    s->stride = qdot_taylor_stride(s->taylor);
    s->newest = qdot_taylor_input(s->taylor, 0);
    s->other = qdot_taylor_input(s->taylor, n);
    s->velocity = qdot_taylor_input(s->taylor, first + n);
    s->t = qdot_taylor_input(s->taylor, first + 2 * n);
    return QDOT_OK;
}

static void
couple(qdot_constrained_series *e, size_t to, const double *series, const double *of)
{
    e->couplings[e->n_couplings++] = (coupling){to, series, of};
}

/* Where outputs are found, and which entries move. */
static qdot_status
find_outputs(qdot_constrained_series *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->plan->n;
    size_t at[3];

    e->couplings = qdot_calloc(2 * c->n_masses + c->n_slopes + 1, sizeof *e->couplings);
    if (!e->couplings)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        e->f[i] = qdot_taylor_output(e->motion, i);
    for (size_t k = 0; k < c->n_masses; k++) {
        size_t i = c->masses[k].row, j = c->masses[k].column;

        e->M[k] = qdot_taylor_output(e->motion, n + k);
        if (qdot_taylor_is_constant(e->motion, n + k))
            continue;
        couple(e, i, e->M[k], e->a + j * e->stride);
        if (i != j)
            couple(e, j, e->M[k], e->a + i * e->stride);
    }
    for (int kind = 0; kind < 3; kind++)
        at[kind] = c->count[kind];
    for (size_t k = 0; k < c->n_slopes; k++) {
        size_t row = c->slopes[k].row;
        qdot_constraint_kind kind = c->rows[row].kind;
        qdot_taylor *taylor = e->kinds[kind].taylor;
        size_t output = at[kind]++;

        e->A[k] = qdot_taylor_output(taylor, output);
        if (!qdot_taylor_is_constant(taylor, output))
            couple(e, c->slopes[k].column, e->A[k], e->lambda + row * e->stride);
    }
    for (size_t r = 0; r < c->m; r++)
        e->rows[r] =
            qdot_taylor_output(e->kinds[c->rows[r].kind].taylor, c->rows[r].of_kind);
    return QDOT_OK;
}

/* Nanoseconds, as measured on a machine of 2023; only their ratios matter. */
static void
estimate_cost(qdot_constrained_series *e)
{
    double *cost = e->series.cost, n = (double)e->plan->n, all = n + (double)e->c->m;
    double length = (double)qdot_taylor_length(e->motion);

    for (int kind = 0; kind < 3; kind++)
        if (e->kinds[kind].taylor)
            length += 2 * (double)qdot_taylor_length(e->kinds[kind].taylor);
    cost[0] = 500 + 15.0 * (double)qdot_tape_calls(e->plan->tape) + 4 * length +
              (e->saddle.inverse ? 4 * all * all * all : 2 * n * n * all);
    cost[1] = 20 + 1.2 * length + 3.5 * qdot_constrained_series_convolutions(e) + 10 * n +
              (e->saddle.inverse ? 0.5 : 3) * all * all;
    cost[2] = 0.12 * qdot_constrained_series_convolutions(e);
}

static qdot_status
make(qdot_constrained_series *e, bool shaken)
{
    const qdot_plan *p = e->plan;
    const qdot_constraints *c = e->c;

    QDOT_TRY(qdot_taylor_new_shaken(c->motion, shaken, most_order, &e->motion));
    for (int kind = 0; kind < 3; kind++)
        QDOT_TRY(make_kind(e, (qdot_constraint_kind)kind, shaken));
    e->stride = qdot_taylor_stride(e->motion);
    e->q = qdot_taylor_input(e->motion, 0);
    e->v = qdot_taylor_input(e->motion, p->n);
    e->t = qdot_taylor_input(e->motion, 2 * p->n);
    e->a = qdot_calloc(p->n * e->stride, sizeof *e->a);
    e->lambda = qdot_calloc(c->m * e->stride, sizeof *e->lambda);
    e->newest = qdot_calloc(p->n, sizeof *e->newest);
    e->weak = qdot_calloc(c->m + p->n, sizeof *e->weak);
    e->f = qdot_calloc(p->n, sizeof *e->f);
    e->M = qdot_calloc(c->n_masses + 1, sizeof *e->M);
    e->A = qdot_calloc(c->n_slopes + 1, sizeof *e->A);
    e->rows = qdot_calloc(c->m, sizeof *e->rows);
    if (!e->a || !e->lambda || !e->newest || !e->weak || !e->f || !e->M || !e->A ||
        !e->rows)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_saddle_init(&e->saddle, p->n, c->m, p->indefinite));
    QDOT_TRY(find_outputs(e));
    e->series = (qdot_ode_series){.most = most_order - 4,
                                  .x = e->q,
                                  .stride = e->stride,
                                  .checked = p->n,
                                  .begin = begin,
                                  .extend = extend,
                                  .noise = noise,
                                  .ahead = ahead,
                                  .user = e};
    estimate_cost(e);
    return QDOT_OK;
}

qdot_status
qdot_constrained_series_new(const qdot_plan *plan, bool shaken,
                            qdot_constrained_series **tied)
{
    qdot_constrained_series *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *tied = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->plan = plan;
    e->c = plan->constraints;
    e->kernels = qdot_series_kernels_get();
    status = make(e, shaken);
    if (status != QDOT_OK) {
        qdot_constrained_series_free(e);
        return status;
    }
    *tied = e;
    return QDOT_OK;
}

void
qdot_constrained_series_free(qdot_constrained_series *e)
{
    if (!e)
        return;
    qdot_taylor_free(e->motion);
    for (int kind = 0; kind < 3; kind++)
        qdot_taylor_free(e->kinds[kind].taylor);
    qdot_saddle_clear(&e->saddle);
    qdot_free(e->a);
    qdot_free(e->lambda);
    qdot_free(e->newest);
    qdot_free(e->weak);
    qdot_free(e->f);
    qdot_free(e->M);
    qdot_free(e->A);
    qdot_free(e->rows);
    qdot_free(e->couplings);
    qdot_free(e);
}

const qdot_ode_series *
qdot_constrained_series_get(const qdot_constrained_series *e)
{
    return &e->series;
}

double
qdot_constrained_series_convolutions(const qdot_constrained_series *e)
{
    double sum = qdot_taylor_convolutions(e->motion) + (double)e->n_couplings;

    for (int kind = 0; kind < 3; kind++)
        if (e->kinds[kind].taylor)
            sum += qdot_taylor_convolutions(e->kinds[kind].taylor);
    return sum;
}

size_t
qdot_constrained_series_factored(const qdot_constrained_series *e)
{
    return e->saddle.factored;
}
