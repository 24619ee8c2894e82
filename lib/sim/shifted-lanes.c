/* shifted-lanes.c -- order by order as shifted.c, for all lanes. */
#include "sim/shifted-lanes.h"

#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "sim/blocks.h"
#include "tape/lanes.h"
#include "tape/shake.h"
#include "tape/taylor.h"

enum { L = QDOT_LANES, most_order = 44 };

typedef struct {
    double *A, *inverse; /* [n x n groups] of M_0: its factor; inverse */
    double *x, *y;       /* [n groups] */
} solver;

/* For one kind of processor (shifted-lanes.def). */
typedef struct {
    void (*accelerate)(qdot_shifted_lanes *s, int k);
    void (*gather)(qdot_shifted_lanes *s, int k);
    void (*integrate)(qdot_shifted_lanes *s, int m);
} orders;

struct qdot_shifted_lanes {
    const orders *orders;
    const qdot_plan *plan;
    const qdot_residual *residual;
    const qdot_batch_kernels *kernels;
    qdot_lanes *places;
    qdot_tape *masses; /* shaken; NULL: the residual's */
    double *weight;    /* [n_weights] */
    double unit[L];
    double *q, *v, *t;       /* rows of the inputs of `places` */
    size_t stride;           /* groups */
    const double **d;        /* [functions] series of the differences */
    const double **slope;    /* [n_slopes] series */
    const double **Q;        /* [n] series of forces; NULL: zero */
    solver *solvers;         /* [blocks] */
    double *x, *sum;         /* [functions groups] of the order at hand */
    double *F;               /* [functions x stride groups] by order */
    double *R;               /* [n groups] */
    double *in, *out, *work; /* of `masses`, groups */
};

bool
qdot_shifted_lanes_applies(const qdot_plan *plan)
{
    return plan->residual && !plan->residual->forces && !plan->indefinite;
}

/* --- one order ---------------------------------------------------------------------- */

#define BATCH_BODY "sim/shifted-lanes.def"
#include "num/batch-kinds.def"

static const orders *const kinds[] = {
    &portable_orders,
#ifdef QDOT_X86_KINDS
    &avx2_orders,
    &avx512_orders,
#endif
};

/* unit^2 q'' of order k in place of -R. */
static void
solve(qdot_shifted_lanes *s, int k)
{
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const qdot_plan_block *block = s->plan->blocks + b;
        const solver *at = s->solvers + b;
        size_t n = block->n;

        for (size_t i = 0; i < n; i++)
            memcpy(at->x + i * L, s->R + block->index[i] * L, L * sizeof *at->x);
        if (k > 0) {
            s->kernels->multiply(n, at->inverse, at->x, at->y);
        } else {
            memcpy(at->y, at->x, n * L * sizeof *at->y);
            s->kernels->solve(n, at->A, at->y);
        }
        for (size_t i = 0; i < n; i++)
            memcpy(s->R + block->index[i] * L, at->y + i * L, L * sizeof *at->y);
    }
}

/* Coefficients m >= 2 of q and m - 1 of v. */
static void
order(qdot_shifted_lanes *s, int m)
{
    const size_t n = s->plan->n;

    for (size_t i = 0; i < n; i++)
        memset(s->q + (i * s->stride + (size_t)m) * L, 0, L * sizeof *s->q);
    qdot_lanes_order(s->places, m);
    s->orders->accelerate(s, m - 2);
    s->orders->gather(s, m - 2);
    solve(s, m - 2);
    s->orders->integrate(s, m);
    qdot_lanes_correct(s->places, m, n, s->R);
    s->orders->accelerate(s, m - 2);
}

/* M_0 of every block, factored. */
static void
factor(qdot_shifted_lanes *s, const double *t, const double *y)
{
    const qdot_plan *p = s->plan;
    const double *out = s->out;

    memcpy(s->in, y, 2 * p->n * L * sizeof *y);
    memcpy(s->in + 2 * p->n * L, t, L * sizeof *t);
    qdot_lanes_eval(s->masses ? s->masses : s->residual->masses, s->in, s->out, s->work);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        size_t n = block->n;

        if (block->constant)
            continue;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++, out += L)
                memcpy(s->solvers[b].A + (i * n + j) * L, out, L * sizeof *out);
        s->kernels->factor(n, s->solvers[b].A);
    }
}

static void
begin(const double *t, const double *y, const double *unit, void *user)
{
    qdot_shifted_lanes *s = user;
    size_t n = s->plan->n;

    memcpy(s->unit, unit, sizeof s->unit);
    for (size_t i = 0; i < n; i++)
        for (size_t l = 0; l < L; l++) {
            s->q[i * s->stride * L + l] = y[i * L + l];
            s->v[i * s->stride * L + l] = y[(n + i) * L + l];
            s->q[(i * s->stride + 1) * L + l] = unit[l] * y[(n + i) * L + l];
        }
    memcpy(s->t, t, L * sizeof *t);
    memcpy(s->t + L, unit, L * sizeof *unit);
    qdot_lanes_draw(s->places, t);
    factor(s, t, y);
    qdot_lanes_order(s->places, 0);
    qdot_lanes_order(s->places, 1);
    order(s, 2);
}

static void
extend(int p, void *user)
{
    qdot_shifted_lanes *s = user;

    for (size_t b = 0; b < s->plan->structure.blocks; b++)
        if (!s->plan->blocks[b].constant)
            s->kernels->invert(s->plan->blocks[b].n, s->solvers[b].A,
                               s->solvers[b].inverse);
    for (int m = 3; m <= p + 1; m++)
        order(s, m);
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
make_solver(qdot_shifted_lanes *s, size_t b, bool shaken)
{
    const qdot_plan_block *block = s->plan->blocks + b;
    solver *at = s->solvers + b;
    size_t n = block->n;

    at->A = qdot_calloc(n * n * L, sizeof *at->A);
    at->inverse = qdot_calloc(n * n * L, sizeof *at->inverse);
    at->x = qdot_calloc(n * L, sizeof *at->x);
    at->y = qdot_calloc(n * L, sizeof *at->y);
    if (!at->A || !at->inverse || !at->x || !at->y)
        return QDOT_ENOMEM;
    if (!block->constant)
        return QDOT_OK;
    for (size_t i = 0; i < n * n; i++)
        for (size_t l = 0; l < L; l++)
            at->A[i * L + l] =
                shaken ? qdot_shake_double(block->M[i], block->side[i]) : block->M[i];
    s->kernels->factor(n, at->A);
    s->kernels->invert(n, at->A, at->inverse);
    return QDOT_OK;
}

static qdot_status
make_tapes(qdot_shifted_lanes *s, bool shaken, int most)
{
    const qdot_residual *r = s->residual;
    qdot_tape *copy = NULL;
    qdot_status status;

    if (shaken) {
        QDOT_TRY(qdot_tape_shake(r->masses, &s->masses));
        QDOT_TRY(qdot_tape_shake(r->places, &copy));
    }
    status = qdot_lanes_new(copy ? copy : r->places, most + 1, &s->places);
    qdot_tape_free(copy);
    return status;
}

static qdot_status
make(qdot_shifted_lanes *s, bool shaken, int most)
{
    const qdot_plan *p = s->plan;
    const qdot_residual *r = s->residual;

    QDOT_TRY(make_tapes(s, shaken, most));
    s->stride = qdot_lanes_stride(s->places);
    s->q = qdot_lanes_input(s->places, 0);
    s->v = qdot_lanes_input(s->places, p->n);
    s->t = qdot_lanes_input(s->places, 2 * p->n);
    s->d = qdot_calloc(r->functions + 1, sizeof *s->d);
    s->slope = qdot_calloc(r->n_slopes + 1, sizeof *s->slope);
    s->Q = qdot_calloc(p->n, sizeof *s->Q);
    s->weight = qdot_calloc(r->n_weights + 1, sizeof *s->weight);
    s->solvers = qdot_calloc(p->structure.blocks, sizeof *s->solvers);
    s->x = qdot_calloc(r->functions * L + 1, sizeof *s->x);
    s->sum = qdot_calloc(r->functions * L + 1, sizeof *s->sum);
    s->F = qdot_calloc(r->functions * s->stride * L + 1, sizeof *s->F);
    s->R = qdot_calloc(p->n * L, sizeof *s->R);
    s->in = qdot_calloc((2 * p->n + 1) * L, sizeof *s->in);
    s->out = qdot_calloc(qdot_tape_outputs(r->masses) * L + 1, sizeof *s->out);
    s->work = qdot_calloc(qdot_tape_work(r->masses) * L + 1, sizeof *s->work);
    if (!s->d || !s->slope || !s->Q || !s->weight || !s->solvers || !s->x || !s->sum || !s->F || !s->R || !s->in ||
        !s->out || !s->work)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < r->functions; f++)
        s->d[f] = qdot_lanes_output(s->places, f);
    for (size_t j = 0; j < r->n_slopes; j++)
        s->slope[j] = qdot_lanes_output(s->places, r->slopes[j].output);
    for (size_t i = 0; i < p->n; i++)
        if (r->force[i] != UINT32_MAX)
            s->Q[i] = qdot_lanes_output(s->places, r->force[i]);
    for (size_t w = 0; w < r->n_weights; w++)
        s->weight[w] = shaken ? qdot_shake_double(r->weights[w].w, r->weights[w].side)
                              : r->weights[w].w;
    for (size_t b = 0; b < p->structure.blocks; b++)
        QDOT_TRY(make_solver(s, b, shaken));
    return QDOT_OK;
}

qdot_status
qdot_shifted_lanes_new(const qdot_plan *plan, bool shaken, int most,
                       qdot_shifted_lanes **lanes)
{
    qdot_shifted_lanes *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *lanes = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->residual = plan->residual;
    s->kernels = qdot_batch_kernels_get();
    s->orders = kinds[qdot_batch_kind()];
    status = make(s, shaken, most);
    if (status != QDOT_OK) {
        qdot_shifted_lanes_free(s);
        return status;
    }
    *lanes = s;
    return QDOT_OK;
}

void
qdot_shifted_lanes_free(qdot_shifted_lanes *s)
{
    if (!s)
        return;
    for (size_t b = 0; s->solvers && b < s->plan->structure.blocks; b++) {
        qdot_free(s->solvers[b].A);
        qdot_free(s->solvers[b].inverse);
        qdot_free(s->solvers[b].x);
        qdot_free(s->solvers[b].y);
    }
    qdot_lanes_free(s->places);
    qdot_tape_free(s->masses);
    qdot_free(s->d);
    qdot_free(s->slope);
    qdot_free(s->Q);
    qdot_free(s->solvers);
    qdot_free(s->weight);
    qdot_free(s->x);
    qdot_free(s->sum);
    qdot_free(s->F);
    qdot_free(s->R);
    qdot_free(s->in);
    qdot_free(s->out);
    qdot_free(s->work);
    qdot_free(s);
}

qdot_ode_batch
qdot_shifted_lanes_system(qdot_shifted_lanes *s)
{
    return (qdot_ode_batch){.n = 2 * s->plan->n,
                            .checked = s->plan->n,
                            .x = s->q,
                            .stride = s->stride,
                            .begin = begin,
                            .extend = extend,
                            .user = s};
}

/* Nanoseconds for all lanes, as measured with AVX-512; only their ratios matter. */
qdot_status
qdot_shifted_lanes_order(const qdot_plan *plan, double tol, int *order)
{
    const qdot_residual *r = plan->residual;
    qdot_ode_series series = {.most = most_order - 4};
    double *c = series.cost, length, convolutions, n = (double)plan->n;
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new(r->places, 0, &taylor));
    length = (double)qdot_taylor_length(taylor);
    convolutions = qdot_taylor_convolutions(taylor) + (double)r->n_slopes;
    qdot_taylor_free(taylor);
    c[0] = 300 + 100 * (double)qdot_tape_calls(r->places) + 5 * length + 20 * n +
           2 * (double)qdot_tape_operations(r->masses) + n * n * n / 3;
    c[1] = 4 * length + 3 * convolutions + 15 * n + n * n +
           8.0 * (double)(r->functions + r->n_weights);
    c[2] = 0.1 * convolutions;
    *order = qdot_ode_taylor_order(&series, tol, false, 0);
    return QDOT_OK;
}
