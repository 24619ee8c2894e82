/* leading.c -- order by order in two doubles: tape, solve, correct, integrate. */
#include "sim/form/leading.h"

#include <math.h>

#include "base/memory.h"
#include "sim/form/blocks.h"
#include "tape/constant.h"
#include "series/two.h"

/* Corrections of a solution at most, and what of it the next would have to be larger than. */
enum { most_corrections = 4 };
static const double enough = 0x1p-80;

/* An entry of M that moves: of row i of the block, times its acceleration j. */
typedef struct {
    size_t i, j;
    const qdot_two *M;
} coupling;

typedef struct {
    const qdot_two **f; /* [n] */
    const qdot_two **M; /* [n x n] */
    const qdot_two **a; /* [n] what is solved for, or an output */
    qdot_two *solved;   /* [n x stride] of a block of more than one */
    qdot_two *rest;     /* [n] */
    qdot_two *first;    /* [n x n] M_0 */
    qdot_two *newest;   /* [n] of the order at hand */
    coupling *couplings;
    size_t n_couplings;
} leading_block;

struct qdot_leading {
    const qdot_plan *plan;
    const qdot_two_kernels *kernels;
    qdot_two inverse[QDOT_ODE_LEADING_MOST + 2]; /* of whole numbers */
    qdot_tape_two *tape;
    qdot_blocks solvers;
    qdot_ode_leading leading;
    qdot_two *q, *v, *t; /* rows of the inputs, `stride` apart */
    size_t stride;
    double unit;
    leading_block *blocks;
    const qdot_two **a;     /* [n] q''; NULL: of a momentum that is kept */
    const qdot_two **rates; /* [n_kept] */
    const double *hi, *lo;  /* [n_kept]; borrowed */
};

static inline double
larger(double a, double b)
{
    return a > b ? a : b;
}

/* --- one order ----------------------------------------------------------------------- */

static qdot_status
factor(qdot_leading *l, size_t b)
{
    const leading_block *s = l->blocks + b;
    const size_t n = l->plan->blocks[b].n;
    double *to = l->solvers.at[b].a;

    if (l->plan->blocks[b].constant)
        return QDOT_OK;
    for (size_t i = 0; i < n * n; i++) {
        s->first[i] = s->M[i][0];
        to[i] = s->first[i].hi;
    }
    return qdot_blocks_factor(&l->solvers, b);
}

/* a_k of a block from its right-hand side in s->rest. Each correction is smaller than the one
 * before by the same factor, about. */
static void
solve(qdot_leading *l, size_t b, int k)
{
    const leading_block *s = l->blocks + b;
    const size_t n = l->plan->blocks[b].n;
    double *x = l->solvers.at[b].x, last = INFINITY;

    for (size_t i = 0; i < n; i++) {
        x[i] = s->rest[i].hi;
        s->newest[i] = (qdot_two){0, 0};
    }
    for (int tries = 0; tries <= most_corrections; tries++) {
        double most = 0, size = 0;

        qdot_blocks_solve(&l->solvers, b);
        for (size_t i = 0; i < n; i++) {
            s->newest[i] = qdot_two_add_double(s->newest[i], x[i]);
            most = larger(most, fabs(x[i]));
            size = larger(size, fabs(s->newest[i].hi));
        }
        if (tries > 0 && !(most * (most / last) > enough * size))
            break;
        last = most;
        for (size_t i = 0; i < n; i++)
            x[i] = qdot_two_sub(s->rest[i], l->kernels->dot(n, s->first + i * n, s->newest))
                       .hi;
    }
    for (size_t i = 0; i < n; i++)
        s->solved[i * l->stride + (size_t)k] = s->newest[i];
}

/* a_k of every coordinate, orders below k being there. */
static qdot_status
accelerations(qdot_leading *l, int k)
{
    qdot_tape_two_order(l->tape, k);
    for (size_t b = 0; b < l->plan->structure.blocks; b++) {
        const leading_block *s = l->blocks + b;
        const size_t n = l->plan->blocks[b].n;

        if (n == 1)
            continue;
        if (k == 0)
            QDOT_TRY(factor(l, b));
        for (size_t i = 0; i < n; i++)
            s->rest[i] = s->f[i][k];
        for (size_t c = 0; c < s->n_couplings && k > 0; c++) {
            const coupling *m = s->couplings + c;

            s->rest[m->i] =
                qdot_two_sub(s->rest[m->i],
                             l->kernels->convolve((size_t)k, m->M + 1, s->a[m->j] + k - 1));
        }
        solve(l, b, k);
    }
    return QDOT_OK;
}

/* Order k + 1 of velocities and, an order before it is wanted, k + 2 of coordinates. */
static void
integrate(qdot_leading *l, int k)
{
    const qdot_plan *p = l->plan;
    const qdot_two once = qdot_two_scale(l->inverse[k + 1], l->unit);
    const qdot_two twice = qdot_two_scale(l->inverse[k + 2], l->unit);

    for (size_t i = 0; i < p->n; i++) {
        qdot_two *v = l->v + i * l->stride + k + 1;

        if (!l->a[i])
            continue;
        *v = l->kernels->mul(l->a[i][k], once);
        if ((size_t)k + 2 < l->stride)
            l->q[i * l->stride + (size_t)k + 2] = l->kernels->mul(*v, twice);
    }
    for (size_t c = 0; c < p->n_kept; c++)
        l->q[p->kept[c] * l->stride + (size_t)k + 1] =
            l->kernels->mul(l->rates[c][k], once);
}

static qdot_status
begin(const qdot_ode_place *at, double unit, void *user)
{
    qdot_leading *l = user;
    const qdot_plan *p = l->plan;

    l->unit = unit;
    for (size_t i = 0; i < 2 * p->n; i++)
        l->q[i * l->stride] = qdot_two_of(at->y[i], at->carry ? at->carry[i] : 0);
    for (size_t i = 0; i < p->n; i++)
        l->q[i * l->stride + 1] = qdot_two_scale(l->v[i * l->stride], unit);
    l->t[0] = qdot_two_of(at->t, at->t_low);
    l->t[1] = (qdot_two){unit, 0};
    for (size_t c = 0; c < p->n_kept; c++)
        l->t[(c + 1) * l->stride] = (qdot_two){l->hi[c], l->lo[c]};
    return QDOT_OK;
}

static qdot_status
next(int k, void *user)
{
    qdot_leading *l = user;
    double nothing = 0; /* a sum of zeros, if all is finite */

    QDOT_TRY(accelerations(l, k - 1));
    integrate(l, k - 1);
    for (size_t i = 0; i < 2 * l->plan->n; i++) {
        const qdot_two x = l->q[i * l->stride + (size_t)k];

        nothing += 0 * (x.hi + x.lo);
    }
    return nothing == 0 ? QDOT_OK
                        : qdot_fail(QDOT_EDOMAIN,
                                    "the first orders of the motion are not finite");
}

/* --- building ------------------------------------------------------------------------ */

static qdot_status
constant_block(qdot_leading *l, size_t b)
{
    const qdot_plan *p = l->plan;
    const qdot_plan_block *block = p->blocks + b;
    leading_block *s = l->blocks + b;
    const size_t n = block->n;

    for (size_t i = 0; i < n * n; i++) {
        const qdot_expr M = p->M[block->index[i / n] * p->n + block->index[i % n]];
        int side;

        QDOT_TRY(qdot_constant_split(p->pool, M, &s->first[i].hi, &side, &s->first[i].lo));
    }
    return QDOT_OK;
}

/* Its entries are the outputs from *at on. */
static qdot_status
moving_block(qdot_leading *l, size_t b, size_t *at)
{
    const size_t n = l->plan->blocks[b].n;
    leading_block *s = l->blocks + b;

    s->couplings = qdot_calloc(n * n, sizeof *s->couplings);
    if (!s->couplings)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++, ++*at) {
            const qdot_two *M = qdot_tape_two_output(l->tape, *at);

            s->M[i * n + j] = s->M[j * n + i] = M;
            if (qdot_tape_two_is_constant(l->tape, *at))
                continue;
            s->couplings[s->n_couplings++] = (coupling){i, j, M};
            if (i != j)
                s->couplings[s->n_couplings++] = (coupling){j, i, M};
        }
    return QDOT_OK;
}

static qdot_status
make_block(qdot_leading *l, size_t b, size_t *at)
{
    const qdot_plan_block *block = l->plan->blocks + b;
    leading_block *s = l->blocks + b;
    const size_t n = block->n;

    if (n == 1) {
        l->a[block->index[0]] = qdot_tape_two_output(l->tape, (*at)++);
        return QDOT_OK;
    }
    s->f = qdot_calloc(n, sizeof *s->f);
    s->M = qdot_calloc(n * n, sizeof *s->M);
    s->a = qdot_calloc(n, sizeof *s->a);
    s->solved = qdot_calloc(n * l->stride, sizeof *s->solved);
    s->rest = qdot_calloc(2 * n, sizeof *s->rest);
    s->first = qdot_calloc(n * n, sizeof *s->first);
    if (!s->f || !s->M || !s->a || !s->solved || !s->rest || !s->first)
        return QDOT_ENOMEM;
    s->newest = s->rest + n;
    for (size_t i = 0; i < n; i++) {
        s->f[i] = qdot_tape_two_output(l->tape, (*at)++);
        s->a[i] = l->a[block->index[i]] = s->solved + i * l->stride;
    }
    return block->constant ? constant_block(l, b) : moving_block(l, b, at);
}

static qdot_status
make(qdot_leading *l)
{
    const qdot_plan *p = l->plan;
    size_t at = 0;

    QDOT_TRY(qdot_tape_two_new(p->tape, QDOT_ODE_LEADING_MOST, 2 * p->n + 1, &l->tape));
    l->stride = qdot_tape_two_stride(l->tape);
    l->q = qdot_tape_two_input(l->tape, 0);
    l->v = qdot_tape_two_input(l->tape, p->n);
    l->t = qdot_tape_two_input(l->tape, 2 * p->n);
    l->a = qdot_calloc(p->n, sizeof *l->a);
    l->rates = qdot_calloc(p->n_kept + 1, sizeof *l->rates);
    l->blocks = qdot_calloc(p->structure.blocks + 1, sizeof *l->blocks);
    if (!l->a || !l->rates || !l->blocks)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_blocks_init(&l->solvers, p, false));
    for (size_t b = 0; b < p->structure.blocks; b++)
        QDOT_TRY(make_block(l, b, &at));
    for (size_t c = 0; c < p->n_kept; c++)
        l->rates[c] = qdot_tape_two_output(l->tape, at++);
    l->leading =
        (qdot_ode_leading){.x = l->q, .stride = l->stride, .begin = begin, .next = next, .user = l};
    return QDOT_OK;
}

qdot_status
qdot_leading_new(const qdot_plan *plan, qdot_leading **out)
{
    qdot_leading *l = qdot_calloc(1, sizeof *l);
    qdot_status status;

    *out = NULL;
    if (!l)
        return QDOT_ENOMEM;
    l->plan = plan;
    l->kernels = qdot_two_kernels_get();
    for (int k = 1; k < QDOT_ODE_LEADING_MOST + 2; k++)
        l->inverse[k] = qdot_two_div_double((qdot_two){1, 0}, k);
    status = make(l);
    if (status != QDOT_OK) {
        qdot_leading_free(l);
        return status;
    }
    *out = l;
    return QDOT_OK;
}

void
qdot_leading_free(qdot_leading *l)
{
    if (!l)
        return;
    for (size_t b = 0; l->blocks && b < l->plan->structure.blocks; b++) {
        leading_block *s = l->blocks + b;

        qdot_free(s->f);
        qdot_free(s->M);
        qdot_free(s->a);
        qdot_free(s->solved);
        qdot_free(s->rest);
        qdot_free(s->first);
        qdot_free(s->couplings);
    }
    qdot_blocks_clear(&l->solvers);
    qdot_tape_two_free(l->tape);
    qdot_free(l->a);
    qdot_free(l->rates);
    qdot_free(l->blocks);
    qdot_free(l);
}

void
qdot_leading_keep(qdot_leading *l, const double *hi, const double *lo)
{
    l->hi = hi;
    l->lo = lo;
}

const qdot_ode_leading *
qdot_leading_get(const qdot_leading *l)
{
    return &l->leading;
}
