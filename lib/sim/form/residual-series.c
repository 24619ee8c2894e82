/* residual-series.c -- order by order: places with the newest coefficient 0, accelerations by
 * shifting, forces from the leaves to the roots, solve, correct. */
#include "sim/form/residual-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/cholesky.h"
#include "num/series.h"
#include "sim/form/blocks.h"
#include "sim/form/derived.h"
#include "sim/form/residual-sweeps.h"
#include "sim/form/residual-vectors.h"
#include "tape/shake.h"
#include "series/taylor.h"

enum { most_order = 44, lanes = 8 };

/* Up to so many functions the tree is kept multiplied out: a matrix is work of another
 * order, but vectors take it, where a tree is one long chain of sums. */
enum { most_dense = 48 };

/* A pivot over the mass it is of from which on four digits are lost: M may be singular. */
static const double least_pivot = 1e-4;

struct qdot_residual_series {
    const qdot_plan *plan;
    const qdot_residual *residual;
    const qdot_series_kernels *kernels;
    qdot_taylor *places, *forces;
    qdot_tape *masses;
    double *weight; /* [n_weights] */
    qdot_blocks solvers;
    qdot_ode_series series;
    double unit, force_scale; /* unit^2 */
    double *q, *v, *t;        /* rows of the inputs of `places` */
    double *fq, *fv, *ft;     /* of `forces` */
    size_t stride, forces_stride;

    const double **d;       /* [functions] series of the differences */
    const double **applied; /* [n] series of Q; NULL: zero */
    double *x, *F;          /* [functions] unit^2 x'', unit^2 F of the order at hand */
    size_t rows;            /* functions, filled up to full vectors */
    double *W;              /* [rows x functions] F = W d''; NULL: by the tree */
    size_t members;         /* slopes, filled up to full vectors */
    const double **slope;   /* [n_slopes] series */
    double *J;              /* [orders x members] their coefficients, by order */
    double *Fs;             /* [orders x members] F of each slope's function */
    bool one_each;          /* a slope a function, in their order: Fs is F */
    double *products;       /* [members] */
    qdot_residual_vectors *wide; /* all this by vectors; NULL: one by one */
    qdot_residual_sweeps *tree;  /* and M eliminated along its tree; NULL: it has none */
    size_t eliminated;           /* how often */
    double *R;                   /* [n] */
    bool whole;                  /* one block holds all coordinates, in their order */
    double *in, *out, *work;     /* of `masses` */
};

/* --- one order ---------------------------------------------------------------------- */

/* F of order k from coefficients k + 2 of the differences. */
static void
accelerate(const qdot_residual_series *s, int k)
{
    const qdot_residual *r = s->residual;
    const double factor = (k + 1) * (k + 2);
    double *Fs = s->Fs + (size_t)k * s->members, *F = s->one_each ? Fs : s->F;

    for (size_t f = 0; f < r->functions; f++)
        s->x[f] = factor * s->d[f][k + 2];
    if (s->W)
        s->kernels->multiply(s->rows, r->functions, s->W, s->x, F);
    else
        qdot_residual_forces(r, s->weight, s->x, F);
    for (size_t j = 0; j < r->n_slopes && !s->one_each; j++)
        Fs[j] = F[r->slopes[j].function];
}

/* Coefficient k of the slopes, by member. */
static void
take_slopes(const qdot_residual_series *s, int k)
{
    const double *const *slope = s->slope;
    double *J = s->J + (size_t)k * s->members;

    for (size_t j = 0; j < s->residual->n_slopes; j++)
        J[j] = slope[j][k];
}

/* Order k of the forces that hold velocities. */
static void
evaluate_forces(qdot_residual_series *s, int k)
{
    if (!s->forces)
        return;
    for (size_t i = 0; i < s->plan->n; i++) {
        s->fq[i * s->forces_stride + (size_t)k] = s->q[i * s->stride + (size_t)k];
        s->fv[i * s->forces_stride + (size_t)k] = s->v[i * s->stride + (size_t)k];
    }
    qdot_taylor_order(s->forces, k);
}

/* unit^2 q'' of the blocks from -R, in its place. */
static void
solve_blocks(const qdot_residual_series *s, int k)
{
    const qdot_plan *p = s->plan;

    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        double *x = s->solvers.at[b].x;

        if (block->n == 1) {
            s->R[block->index[0]] /= s->solvers.at[b].a[0];
            continue;
        }
        for (size_t i = 0; i < block->n; i++)
            x[i] = s->R[block->index[i]];
        if (k <= QDOT_BLOCKS_SOLVED)
            qdot_blocks_solve(&s->solvers, b);
        else
            qdot_blocks_apply(&s->solvers, b);
        for (size_t i = 0; i < block->n; i++)
            s->R[block->index[i]] = x[i];
    }
}

/* -R of order k, what q has at order k + 2 taken as 0. */
static void
residual_of(qdot_residual_series *s, int k)
{
    const qdot_residual *r = s->residual;

    accelerate(s, k);
    s->kernels->dots(s->members, (size_t)k + 1, s->J, s->Fs + (size_t)k * s->members,
                     s->products);
    for (size_t i = 0; i < s->plan->n; i++)
        s->R[i] = s->applied[i] ? s->force_scale * s->applied[i][k] : 0;
    for (size_t j = 0; j < r->n_slopes; j++)
        s->R[r->slopes[j].coordinate] -= s->products[j];
}

/* The same by vectors; they have what `places` applies. */
static void
wide_residual(qdot_residual_series *s, int m)
{
    const qdot_residual *r = s->residual;

    qdot_residual_vectors_residual(s->wide, m, s->force_scale, s->R);
    for (size_t i = 0; i < s->plan->n && s->forces; i++)
        if (s->applied[i] && r->force[i] & QDOT_RESIDUAL_FORCES)
            s->R[i] += s->force_scale * s->applied[i][m - 2];
}

/* unit^2 q'' of order k from -R; where it is left. */
static const double *
solve(const qdot_residual_series *s, int k)
{
    const qdot_solver *all = s->solvers.at;

    if (s->whole && k > QDOT_BLOCKS_SOLVED) {
        s->kernels->multiply(all->m, s->plan->n, all->inverse, s->R, all->lower);
        return all->lower;
    }
    solve_blocks(s, k);
    return s->R;
}

/* Coefficients m of q, in R, are known now. */
static void
correct(qdot_residual_series *s, int m)
{
    if (s->wide) {
        qdot_residual_vectors_correct(s->wide, m, s->R);
        for (size_t i = 0; i < s->plan->n; i++)
            s->q[i * s->stride + (size_t)m] = s->R[i];
        return;
    }
    qdot_taylor_correct(s->places, m, s->R);
    accelerate(s, m - 2);
    take_slopes(s, m);
}

/* Order m by the tree. */
static void
tree_order(qdot_residual_series *s, int m)
{
    evaluate_forces(s, m - 2);
    for (size_t i = 0; i < s->plan->n && s->forces; i++)
        s->R[i] = s->applied[i] && s->residual->force[i] & QDOT_RESIDUAL_FORCES
                      ? s->force_scale * s->applied[i][m - 2]
                      : 0;
    qdot_residual_sweeps_order(s->tree, m, s->force_scale, s->forces ? s->R : NULL);
    if (s->forces)
        qdot_residual_sweeps_rows(s->tree, m, 1 / s->unit, s->q, s->v, s->stride);
}

/* Coefficients m >= 2 of q and m - 1 of v. */
static void
order(qdot_residual_series *s, int m)
{
    const size_t n = s->plan->n;
    const int k = m - 2;
    const double inverse = 1.0 / (m * (m - 1)), per_unit = m / s->unit;
    const double *a;

    if (s->tree) {
        tree_order(s, m);
        return;
    }
    evaluate_forces(s, k);
    if (s->wide) {
        wide_residual(s, m);
    } else {
        for (size_t i = 0; i < n; i++)
            s->q[i * s->stride + (size_t)m] = 0;
        qdot_taylor_order(s->places, m);
        residual_of(s, k);
    }
    a = solve(s, k);
    for (size_t i = 0; i < n; i++)
        s->R[i] = k <= QDOT_TAYLOR_EXACT ? a[i] / (m * (m - 1)) : inverse * a[i];
    correct(s, m);
    for (size_t i = 0; i < n; i++)
        s->v[i * s->stride + (size_t)m - 1] = per_unit * s->R[i];
}

static qdot_status
factor(qdot_residual_series *s, double t, const double *y)
{
    const qdot_plan *p = s->plan;
    const double *out = s->out;

    memcpy(s->in, y, 2 * p->n * sizeof *y);
    s->in[2 * p->n] = t;
    qdot_tape_eval(s->masses ? s->masses : s->residual->masses, s->in, s->out, s->work);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        if (p->blocks[b].constant)
            continue;
        out = qdot_blocks_unpack(&s->solvers, b, out);
        if (p->blocks[b].n > 1)
            QDOT_TRY(qdot_blocks_factor(&s->solvers, b));
    }
    return QDOT_OK;
}

/* The same of an M without a tape. */
static qdot_status
factor_unformed(qdot_residual_series *s)
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

/* Orders 0 and 1, and M eliminated along its tree. Where a pivot is small against its mass
 * Cholesky's method says whether M is singular. */
static qdot_status
begin_tree(qdot_residual_series *s, double t, const double *y)
{
    double lost;
    bool good;

    qdot_taylor_order(s->places, 0);
    for (size_t i = 0; i < s->plan->n; i++)
        s->R[i] = s->unit * y[s->plan->n + i];
    good = qdot_residual_sweeps_begin(s->tree, s->places, s->R, &lost);
    s->eliminated++;
    if (good && lost >= least_pivot)
        return QDOT_OK;
    QDOT_TRY(s->residual->masses ? factor(s, t, y) : factor_unformed(s));
    return good
               ? QDOT_OK
               : qdot_fail(QDOT_ESINGULAR, "the mass matrix is singular within rounding");
}

static qdot_status
begin_orders(qdot_residual_series *s, double t, const double *y)
{
    if (s->tree)
        return begin_tree(s, t, y);
    QDOT_TRY(factor(s, t, y));
    for (int k = 0; k < (s->wide ? 1 : 2); k++) {
        qdot_taylor_order(s->places, k);
        take_slopes(s, k);
    }
    if (s->wide) {
        for (size_t i = 0; i < s->plan->n; i++)
            s->R[i] = s->unit * y[s->plan->n + i];
        qdot_residual_vectors_begin(s->wide, s->places, s->R);
    }
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_residual_series *s = user;
    size_t n = s->plan->n;

    s->unit = unit;
    s->force_scale = unit * unit;
    for (size_t i = 0; i < n; i++) {
        s->q[i * s->stride] = y[i];
        s->v[i * s->stride] = y[n + i];
        s->q[i * s->stride + 1] = unit * y[n + i];
    }
    s->t[0] = t;
    s->t[1] = unit;
    qdot_taylor_draw(s->places, t);
    if (s->forces) {
        s->ft[0] = t;
        s->ft[1] = unit;
        qdot_taylor_draw(s->forces, t);
    }
    QDOT_TRY(begin_orders(s, t, y));
    order(s, 2);
    if (s->tree)
        qdot_residual_sweeps_rows(s->tree, 2, 1 / unit, s->q, s->v, s->stride);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(s->v[i * s->stride + 1]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             s->plan->names[i]);
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    qdot_residual_series *s = user;

    for (size_t b = 0; b < s->plan->structure.blocks && !s->tree; b++)
        if (s->plan->blocks[b].n > 1 && !s->plan->blocks[b].constant)
            qdot_blocks_invert(&s->solvers, b);
    for (int m = 3; m <= p + 1; m++)
        order(s, m);
    if (s->tree)
        qdot_residual_sweeps_rows(s->tree, p + 1, 1 / s->unit, s->q, s->v, s->stride);
    return QDOT_OK;
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
make_tapes(qdot_residual_series *s, bool shaken)
{
    const qdot_residual *r = s->residual;
    size_t n = s->plan->n;

    QDOT_TRY(qdot_taylor_new_shaken(r->places, shaken, most_order, &s->places));
    QDOT_TRY(qdot_taylor_affine(s->places, n, NULL));
    s->stride = qdot_taylor_stride(s->places);
    s->q = qdot_taylor_input(s->places, 0);
    s->v = qdot_taylor_input(s->places, n);
    s->t = qdot_taylor_input(s->places, 2 * n);
    if (r->forces) {
        QDOT_TRY(qdot_taylor_new_shaken(r->forces, shaken, most_order, &s->forces));
        s->forces_stride = qdot_taylor_stride(s->forces);
        s->fq = qdot_taylor_input(s->forces, 0);
        s->fv = qdot_taylor_input(s->forces, n);
        s->ft = qdot_taylor_input(s->forces, 2 * n);
    }
    return shaken && r->masses ? qdot_tape_shake(r->masses, &s->masses) : QDOT_OK;
}

/* Applied forces with velocities have a program of their own. */
static void
estimate_forces(const qdot_residual_series *s, double *c)
{
    if (!s->forces)
        return;
    c[1] += 1.2 * (double)qdot_taylor_length(s->forces) +
            3.5 * qdot_taylor_convolutions(s->forces);
    c[2] += 0.12 * qdot_taylor_convolutions(s->forces);
}

/* Vectors take so much more than counts of their work say, beside direct.c's orders. */
static const double vectors = 1.8;

static void
scale(double *c, double factor)
{
    for (int k = 0; k < 3; k++)
        c[k] *= factor;
}

/* By vectors. */
static void
estimate_wide(const qdot_residual_series *s, double *c)
{
    const double n = (double)s->plan->n;
    double convolutions, products, begun;

    qdot_residual_vectors_count(s->wide, &convolutions, &products, &begun);
    c[0] = 600 + 25.0 * (double)qdot_tape_calls(s->residual->places) +
           1.2 * (double)qdot_tape_operations(s->residual->masses) + 40 * n + 4 * n * n +
           0.25 * n * n * n;
    c[1] = 20 + 4 * begun + 0.5 * products + 3 * n + 0.3 * n * n;
    /* more than it takes: orders near 40 cost the last digits */
    c[2] = 0.3 * convolutions;
    scale(c, vectors);
    estimate_forces(s, c);
}

/* By the tree. */
static void
estimate_tree(const qdot_residual_series *s, double *c)
{
    const double n = (double)s->plan->n;
    double convolutions, products, begun;

    qdot_residual_sweeps_count(s->tree, &convolutions, &products, &begun);
    c[0] = 400 + 20.0 * (double)qdot_tape_calls(s->residual->places) + 40 * n;
    c[1] = 20 + begun + 0.4 * products + n;
    c[2] = 0.3 * convolutions;
    scale(c, vectors);
    estimate_forces(s, c);
}

/* Nanoseconds, as measured on a machine of 2023; only their ratios matter. */
static void
estimate_cost(qdot_residual_series *s)
{
    const qdot_plan *p = s->plan;
    const qdot_residual *r = s->residual;
    double *c = s->series.cost, n = (double)p->n;
    double length = (double)qdot_taylor_length(s->places) +
                    (s->forces ? (double)qdot_taylor_length(s->forces) : 0);
    double scalar = qdot_taylor_convolutions(s->places) +
                    (s->forces ? qdot_taylor_convolutions(s->forces) : 0);

    if (s->tree) {
        estimate_tree(s, c);
        return;
    }
    if (s->wide) {
        estimate_wide(s, c);
        return;
    }
    c[0] = 100 + 15.0 * (double)qdot_tape_calls(r->places) +
           1.0 * (double)qdot_tape_operations(r->masses) + 2 * length + 10 * n;
    c[1] = 10 + 3 * length + 3.5 * scalar + 6 * n + 6.0 * (double)r->functions +
           3.0 * (double)r->n_slopes + 2.0 * (double)r->n_weights;
    c[2] = 0.12 * scalar + 0.04 * (double)s->members;
    for (size_t b = 0; b < p->structure.blocks; b++) {
        n = (double)p->blocks[b].n;
        if (n == 1)
            continue;
        c[1] += 5 * n + 0.5 * n * n;
        c[0] += 5 * n + 0.2 * n * n * n;
    }
}

/* Orders of forces end two below that of q. */
static double
near(int p, double step, void *user)
{
    const qdot_residual_series *s = user;

    step = qdot_taylor_near(s->places, p - 2, step);
    return s->forces ? qdot_taylor_near(s->forces, p - 2, step) : step;
}

static bool
has_exponentials(const qdot_residual_series *s)
{
    return qdot_taylor_has_exponentials(s->places) ||
           (s->forces && qdot_taylor_has_exponentials(s->forces));
}

static const double *
applied(const qdot_residual_series *s, uint32_t at)
{
    if (at == UINT32_MAX)
        return NULL;
    if (at & QDOT_RESIDUAL_FORCES)
        return qdot_taylor_output(s->forces, at ^ QDOT_RESIDUAL_FORCES);
    return qdot_taylor_output(s->places, at);
}

/* W by its columns: what the tree makes of unit vectors. Beside a factored M only. */
static qdot_status
multiply_out(qdot_residual_series *s)
{
    size_t n = s->residual->functions;

    if (n > most_dense || !s->residual->masses)
        return QDOT_OK;
    s->W = qdot_calloc(s->rows * n + 1, sizeof *s->W);
    if (!s->W)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < n; f++) {
        memset(s->x, 0, n * sizeof *s->x);
        s->x[f] = 1;
        qdot_residual_forces(s->residual, s->weight, s->x, s->F);
        memcpy(s->W + f * s->rows, s->F, n * sizeof *s->F);
    }
    return QDOT_OK;
}

/* Orders by vectors, along the tree or by W and M, whichever costs less. */
static qdot_status
choose_vectors(qdot_residual_series *s)
{
    const qdot_residual *r = s->residual;
    qdot_ode_series tree = {.most = most_order - 4}, wide = tree;

    QDOT_TRY(qdot_residual_sweeps_new(r, s->plan->n, s->places, s->weight, &s->tree));
    if (s->W)
        QDOT_TRY(
            qdot_residual_vectors_new(r, s->plan->n, s->places, s->W, s->rows, &s->wide));
    if (!s->tree || !s->wide)
        return QDOT_OK;
    estimate_tree(s, tree.cost);
    estimate_wide(s, wide.cost);
    if (qdot_plan_cost(&tree) < qdot_plan_cost(&wide)) {
        qdot_residual_vectors_free(s->wide);
        s->wide = NULL;
    } else {
        qdot_residual_sweeps_free(s->tree);
        s->tree = NULL;
    }
    return QDOT_OK;
}

/* Where M is factored. */
static qdot_status
make_solvers(qdot_residual_series *s, bool shaken)
{
    const qdot_plan *p = s->plan;
    const qdot_tape *masses = s->residual->masses;

    s->out = qdot_calloc(qdot_tape_outputs(masses) + 1, sizeof *s->out);
    s->work = qdot_calloc(qdot_tape_work(masses) + 1, sizeof *s->work);
    if (!s->out || !s->work)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_blocks_init(&s->solvers, p, shaken));
    for (size_t b = 0; b < p->structure.blocks; b++)
        if (p->blocks[b].n > 1) {
            QDOT_TRY(qdot_blocks_prepare(&s->solvers, b));
            if (p->blocks[b].constant)
                qdot_blocks_invert(&s->solvers, b);
        }
    s->whole = p->structure.blocks == 1 && s->solvers.at->inverse;
    for (size_t i = 0; i < p->n; i++)
        s->whole = s->whole && p->blocks->index[i] == i;
    return QDOT_OK;
}

static qdot_status
make(qdot_residual_series *s, bool shaken)
{
    const qdot_plan *p = s->plan;
    const qdot_residual *r = s->residual;
    size_t orders = most_order + 1;

    QDOT_TRY(make_tapes(s, shaken));
    if (r->masses)
        QDOT_TRY(make_solvers(s, shaken));
    s->members = (r->n_slopes + lanes - 1) / lanes * lanes;
    s->weight = qdot_calloc(r->n_weights, sizeof *s->weight);
    s->d = qdot_calloc(r->functions, sizeof *s->d);
    s->rows = (r->functions + lanes - 1) / lanes * lanes;
    s->x = qdot_calloc(s->rows, sizeof *s->x);
    s->F = qdot_calloc(s->rows, sizeof *s->F);
    s->slope = qdot_calloc(r->n_slopes + 1, sizeof *s->slope);
    s->J = qdot_calloc(orders * s->members + 1, sizeof *s->J);
    s->Fs = qdot_calloc(orders * s->members + 1, sizeof *s->Fs);
    s->products = qdot_calloc(s->members + 1, sizeof *s->products);
    s->R = qdot_calloc(p->n + lanes, sizeof *s->R);
    s->applied = qdot_calloc(p->n, sizeof *s->applied);
    s->in = qdot_calloc(2 * p->n + 1, sizeof *s->in);
    if (!s->weight || !s->d || !s->x || !s->F || !s->slope || !s->J || !s->Fs ||
        !s->products || !s->R || !s->applied || !s->in)
        return QDOT_ENOMEM;
    for (size_t w = 0; w < r->n_weights; w++)
        s->weight[w] = shaken ? qdot_shake_double(r->weights[w].w, r->weights[w].side)
                              : r->weights[w].w;
    for (size_t f = 0; f < r->functions; f++)
        s->d[f] = qdot_taylor_output(s->places, f);
    for (size_t j = 0; j < r->n_slopes; j++)
        s->slope[j] = qdot_taylor_output(s->places, r->slopes[j].output);
    for (size_t i = 0; i < p->n; i++)
        s->applied[i] = applied(s, r->force[i]);
    s->one_each = r->n_slopes == r->functions;
    for (size_t j = 0; j < r->n_slopes; j++)
        s->one_each = s->one_each && r->slopes[j].function == j;
    QDOT_TRY(multiply_out(s));
    QDOT_TRY(choose_vectors(s));
    s->series = (qdot_ode_series){.most = most_order - 4,
                                  .x = s->q,
                                  .stride = s->stride,
                                  .checked = p->n,
                                  .begin = begin,
                                  .extend = extend,
                                  .near = has_exponentials(s) ? near : NULL,
                                  .user = s};
    estimate_cost(s);
    return QDOT_OK;
}

qdot_status
qdot_residual_series_new(const qdot_plan *plan, const qdot_residual *residual,
                         bool shaken, qdot_residual_series **series)
{
    qdot_residual_series *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *series = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->residual = residual;
    s->kernels = qdot_series_kernels_get();
    status = make(s, shaken);
    if (status != QDOT_OK) {
        qdot_residual_series_free(s);
        return status;
    }
    *series = s;
    return QDOT_OK;
}

void
qdot_residual_series_free(qdot_residual_series *s)
{
    if (!s)
        return;
    qdot_taylor_free(s->places);
    qdot_taylor_free(s->forces);
    qdot_tape_free(s->masses);
    if (s->solvers.plan)
        qdot_blocks_clear(&s->solvers);
    qdot_residual_vectors_free(s->wide);
    qdot_residual_sweeps_free(s->tree);
    qdot_free(s->weight);
    qdot_free(s->d);
    qdot_free(s->x);
    qdot_free(s->F);
    qdot_free(s->W);
    qdot_free(s->slope);
    qdot_free(s->J);
    qdot_free(s->Fs);
    qdot_free(s->products);
    qdot_free(s->R);
    qdot_free(s->applied);
    qdot_free(s->in);
    qdot_free(s->out);
    qdot_free(s->work);
    qdot_free(s);
}

const qdot_ode_series *
qdot_residual_series_get(const qdot_residual_series *s)
{
    return &s->series;
}

double
qdot_residual_series_convolutions(const qdot_residual_series *s)
{
    return qdot_taylor_convolutions(s->places) +
           (s->forces ? qdot_taylor_convolutions(s->forces) : 0) +
           (double)s->residual->n_slopes;
}

size_t
qdot_residual_series_tree_size(const qdot_residual_series *s, bool *path)
{
    *path = s->tree && qdot_residual_sweeps_is_path(s->tree);
    return s->tree ? qdot_residual_sweeps_nodes(s->tree) : 0;
}

bool
qdot_residual_series_is_wide(const qdot_residual_series *s)
{
    return s->wide || s->tree;
}

size_t
qdot_residual_series_factored(const qdot_residual_series *s)
{
    return s->solvers.factored + s->eliminated;
}
