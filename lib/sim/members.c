/* members.c -- order by order: tape, solve, integrate twice, for all lanes. */
#include "sim/members.h"

#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "tape/lanes.h"
#include "tape/taylor.h"

enum { L = QDOT_LANES, most_order = 44 };

/* An entry of M that moves: of row i, times the acceleration j. */
typedef struct {
    size_t i, j; /* within the block */
    const double *M;
} coupling;

typedef struct {
    const size_t *index; /* [n] its coordinates */
    const double **f; /* [n] series of the block's f */
    const double **M; /* lower triangle by rows */
    coupling *couplings;
    size_t n_couplings;
    double *A, *inverse; /* [n x n groups] of M_0: its factor; inverse */
    double *x, *y;       /* [n groups] right-hand side, solution */
} block_series;

/* For one kind of processor (members.def): x = f_k - sum M_j a_{k-j}; solved_k = x; the
 * next orders of q and v. */
typedef struct {
    void (*couple)(size_t n, int k, const block_series *s, const double *const *a,
                   qdot_batch_dot *dot);
    void (*keep)(size_t n, int k, const block_series *s, size_t stride, double *solved);
    void (*integrate)(size_t n, int k, const double *unit, const double *const *a,
                      double *q, double *v, size_t stride);
} members_kernels;

struct qdot_members {
    const qdot_members_model *model;
    const qdot_batch_kernels *kernels;
    const members_kernels *orders;
    qdot_lanes *lanes;
    const double *parameters;
    double unit[L];
    double *q, *v, *t;      /* rows of the inputs */
    size_t stride;          /* groups */
    const double **outputs; /* of the tape */
    block_series *blocks;   /* [blocks] */
    const double **a;       /* [n] series of q'': an output of the tape, or */
    double *solved;         /* [n x stride groups] */
};

static size_t
block_size(const qdot_members *m, size_t b)
{
    return m->model->structure.start[b + 1] - m->model->structure.start[b];
}

/* --- one order ---------------------------------------------------------------------- */

#define BATCH_BODY "sim/members.def"
#include "num/batch-kinds.def"

static const members_kernels *const kinds[] = {
    &portable_members,
#ifdef QDOT_X86_KINDS
    &avx2_members,
    &avx512_members,
#endif
};

static void
factor(qdot_members *m, size_t b)
{
    const block_series *s = m->blocks + b;
    size_t n = block_size(m, b), at = 0;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            memcpy(s->A + (i * n + j) * L, s->M[at++], L * sizeof *s->A);
    m->kernels->factor(n, s->A);
}

/* a_k of every coordinate, orders below k being there; then orders k + 1 of velocities
 * and coordinates. */
static void
order(qdot_members *m, int k)
{
    qdot_lanes_order(m->lanes, k);
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const block_series *s = m->blocks + b;
        size_t n = block_size(m, b);

        if (n == 1)
            continue;
        m->orders->couple(n, k, s, m->a, m->kernels->dot[k]);
        if (k > 0) {
            m->kernels->multiply(n, s->inverse, s->x, s->y);
        } else {
            factor(m, b);
            memcpy(s->y, s->x, n * L * sizeof *s->y);
            m->kernels->solve(n, s->A, s->y);
        }
        m->orders->keep(n, k, s, m->stride, m->solved);
    }
    m->orders->integrate(m->model->n, k, m->unit, m->a, m->q, m->v, m->stride);
}

static void
begin(const double *t, const double *y, const double *unit, void *user)
{
    qdot_members *m = user;
    size_t n = m->model->n;

    memcpy(m->unit, unit, sizeof m->unit);
    for (size_t i = 0; i < n; i++) {
        memcpy(m->q + i * m->stride * L, y + i * L, L * sizeof *y);
        memcpy(m->v + i * m->stride * L, y + (n + i) * L, L * sizeof *y);
    }
    memcpy(m->t, t, L * sizeof *t);
    memcpy(m->t + L, unit, L * sizeof *unit);
    qdot_lanes_draw(m->lanes, t);
    order(m, 0);
}

static void
extend(int p, void *user)
{
    qdot_members *m = user;

    for (size_t b = 0; b < m->model->structure.blocks; b++)
        if (block_size(m, b) > 1)
            m->kernels->invert(block_size(m, b), m->blocks[b].A, m->blocks[b].inverse);
    for (int k = 1; k < p; k++)
        order(m, k);
}

static void
take(size_t lane, size_t member, void *user)
{
    qdot_members *m = user;

    for (size_t i = 0; i < m->model->varied; i++)
        qdot_lanes_input(m->lanes, 2 * m->model->n + 1 + i)[lane] =
            m->parameters[member * m->model->varied + i];
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
find_couplings(qdot_members *m, block_series *s, size_t n, size_t at)
{
    s->couplings = qdot_calloc(n * n, sizeof *s->couplings);
    s->A = qdot_calloc(n * n * L, sizeof *s->A);
    s->inverse = qdot_calloc(n * n * L, sizeof *s->inverse);
    s->x = qdot_calloc(n * L, sizeof *s->x);
    s->y = qdot_calloc(n * L, sizeof *s->y);
    if (!s->couplings || !s->A || !s->inverse || !s->x || !s->y)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++, at++) {
            if (qdot_lanes_is_constant(m->lanes, at))
                continue;
            s->couplings[s->n_couplings++] = (coupling){i, j, m->outputs[at]};
            if (i != j)
                s->couplings[s->n_couplings++] = (coupling){j, i, m->outputs[at]};
        }
    return QDOT_OK;
}

static qdot_status
find_outputs(qdot_members *m)
{
    size_t at = 0;

    for (size_t i = 0; i < qdot_tape_outputs(m->model->tape); i++)
        m->outputs[i] = qdot_lanes_output(m->lanes, i);
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const size_t *index = m->model->structure.index + m->model->structure.start[b];
        block_series *s = m->blocks + b;
        size_t n = block_size(m, b);

        s->index = index;
        s->f = m->outputs + at;
        at += n;
        for (size_t i = 0; i < n; i++)
            m->a[index[i]] = n == 1 ? s->f[0] : m->solved + index[i] * m->stride * L;
        if (n == 1)
            continue;
        s->M = m->outputs + at;
        QDOT_TRY(find_couplings(m, s, n, at));
        at += n * (n + 1) / 2;
    }
    return QDOT_OK;
}

static qdot_status
make(qdot_members *m, const qdot_tape *tape, int most)
{
    size_t n = m->model->n;

    QDOT_TRY(qdot_lanes_new(tape, most, &m->lanes));
    m->stride = qdot_lanes_stride(m->lanes);
    m->q = qdot_lanes_input(m->lanes, 0);
    m->v = qdot_lanes_input(m->lanes, n);
    m->t = qdot_lanes_input(m->lanes, 2 * n);
    m->a = qdot_calloc(n, sizeof *m->a);
    m->solved = qdot_calloc(n * m->stride * L, sizeof *m->solved);
    m->outputs = qdot_calloc(qdot_tape_outputs(tape) + 1, sizeof *m->outputs);
    m->blocks = qdot_calloc(m->model->structure.blocks, sizeof *m->blocks);
    if (!m->a || !m->solved || !m->outputs || !m->blocks)
        return QDOT_ENOMEM;
    return find_outputs(m);
}

qdot_status
qdot_members_new(const qdot_members_model *model, const qdot_tape *tape, int most,
                 qdot_members **members)
{
    qdot_members *m = qdot_calloc(1, sizeof *m);
    qdot_status status;

    *members = NULL;
    if (!m)
        return QDOT_ENOMEM;
    m->model = model;
    m->kernels = qdot_batch_kernels_get();
    m->orders = kinds[qdot_batch_kind()];
    status = make(m, tape, most);
    if (status != QDOT_OK) {
        qdot_members_free(m);
        return status;
    }
    *members = m;
    return QDOT_OK;
}

void
qdot_members_free(qdot_members *m)
{
    if (!m)
        return;
    for (size_t b = 0; m->blocks && b < m->model->structure.blocks; b++) {
        qdot_free(m->blocks[b].couplings);
        qdot_free(m->blocks[b].A);
        qdot_free(m->blocks[b].inverse);
        qdot_free(m->blocks[b].x);
        qdot_free(m->blocks[b].y);
    }
    qdot_lanes_free(m->lanes);
    qdot_free(m->outputs);
    qdot_free(m->blocks);
    qdot_free(m->a);
    qdot_free(m->solved);
    qdot_free(m);
}

void
qdot_members_set(qdot_members *m, const double *parameters)
{
    m->parameters = parameters;
}

qdot_ode_batch
qdot_members_system(qdot_members *m)
{
    return (qdot_ode_batch){.n = 2 * m->model->n,
                            .checked = m->model->n,
                            .x = m->q,
                            .stride = m->stride,
                            .take = take,
                            .begin = begin,
                            .extend = extend,
                            .user = m};
}

/* Nanoseconds for all lanes, as measured with AVX-512; only their ratios matter. */
qdot_status
qdot_members_order(const qdot_members_model *model, double tol, int *order)
{
    qdot_ode_series series = {.most = most_order - 4};
    double *c = series.cost, length, convolutions, calls;
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new(model->tape, 0, &taylor));
    length = (double)qdot_taylor_length(taylor);
    convolutions = qdot_taylor_convolutions(taylor);
    calls = (double)qdot_tape_calls(model->tape);
    qdot_taylor_free(taylor);
    c[0] = 300 + 100 * calls + 5 * length + 20 * (double)model->n;
    c[1] = 2 * length + 3 * convolutions + 10 * (double)model->n;
    c[2] = 0.1 * convolutions;
    for (size_t b = 0; b < model->structure.blocks; b++) {
        double n = (double)(model->structure.start[b + 1] - model->structure.start[b]);

        if (n == 1)
            continue;
        c[0] += n * n * n / 6;
        c[1] += 5 * n + n * n;
        c[2] += 0.1 * n * n;
    }
    *order = qdot_ode_taylor_order(&series, tol, false, 0);
    return QDOT_OK;
}
