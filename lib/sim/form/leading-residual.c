/* leading-residual.c -- order by order: places, accelerations by shifting, forces, what is
 * missing, correction. */
#include "sim/form/leading-residual.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "sim/form/blocks.h"
#include "sim/form/residual.h"
#include "series/two.h"

/* Corrections at most; one that is no larger than this leaves nothing for another. */
enum { most_corrections = 4 };
static const double enough = 0x1p-36;

struct qdot_leading_residual {
    const qdot_plan *plan;
    const qdot_residual *residual;
    const qdot_ode_series *series;
    const qdot_two_kernels *kernels;
    qdot_tape_two *places, *forces;
    qdot_ode_leading leading;
    qdot_blocks solvers;
    size_t stride;
    double unit;
    qdot_two *q, *v, *t, *fq, *fv, *ft; /* rows of the inputs of either */
    const qdot_two **d;       /* [functions] differences */
    const qdot_two **slope;   /* [n_slopes] */
    const qdot_two **applied; /* [n] Q; NULL: zero */
    qdot_two *weight;         /* [n_weights] */
    qdot_two *x;              /* [functions] unit^2 x'' of the order at hand */
    qdot_two *F;              /* [functions x stride] */
    qdot_two *R;              /* [n] */
    double *by;               /* [n] */
    double *in, *out, *work;  /* of the masses */
};

/* F of order k from coefficients k + 2 of the differences: down the tree and up again. */
static void
accelerate(const qdot_leading_residual *l, int k)
{
    const qdot_residual *r = l->residual;
    const qdot_two factor = {(k + 1) * (k + 2), 0};
    qdot_two *F = l->F + k;

    for (size_t f = 0; f < r->functions; f++) {
        l->x[f] = l->kernels->mul(l->d[f][k + 2], factor);
        if (r->parent[f] != UINT32_MAX)
            l->x[f] = qdot_two_add(l->x[f], l->x[r->parent[f]]);
        F[f * l->stride] = (qdot_two){0, 0};
    }
    for (size_t w = 0; w < r->n_weights; w++) {
        qdot_two *to = F + r->weights[w].to * l->stride;

        *to = qdot_two_add(*to, l->kernels->mul(l->weight[w], l->x[r->weights[w].from]));
    }
    for (size_t f = r->functions; f-- > 0;)
        if (r->parent[f] != UINT32_MAX) {
            qdot_two *to = F + r->parent[f] * l->stride;

            *to = qdot_two_add(*to, F[f * l->stride]);
        }
}

/* What is missing in coefficients k + 2 of q, into by; its size beside them. */
static double
missing(qdot_leading_residual *l, int k)
{
    const qdot_residual *r = l->residual;
    const qdot_plan *p = l->plan;
    const int m = k + 2;
    double most = 0, size = 0;

    for (size_t i = 0; i < p->n; i++)
        l->R[i] = l->applied[i] ? qdot_two_scale(l->applied[i][k], l->unit * l->unit)
                                : (qdot_two){0, 0};
    for (size_t j = 0; j < r->n_slopes; j++) {
        const qdot_residual_slope *s = r->slopes + j;

        l->R[s->coordinate] = qdot_two_sub(
            l->R[s->coordinate],
            l->kernels->convolve((size_t)k + 1, l->slope[j],
                                 l->F + s->function * l->stride + k));
    }
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        double *x = l->solvers.at[b].x;

        for (size_t i = 0; i < block->n; i++)
            x[i] = l->R[block->index[i]].hi;
        if (block->n == 1)
            x[0] /= l->solvers.at[b].a[0];
        else
            qdot_blocks_solve(&l->solvers, b);
        for (size_t i = 0; i < block->n; i++)
            l->by[block->index[i]] = x[i] / (m * (m - 1));
    }
    for (size_t i = 0; i < p->n; i++) {
        most = fmax(most, fabs(l->by[i]));
        size = fmax(size, fabs(l->q[i * l->stride + (size_t)m].hi));
    }
    return most / size;
}

/* M at y. */
static qdot_status
factor(qdot_leading_residual *l, const qdot_ode_place *at)
{
    const qdot_plan *p = l->plan;
    const double *out = l->out;

    memcpy(l->in, at->y, 2 * p->n * sizeof *l->in);
    l->in[2 * p->n] = at->t;
    qdot_tape_eval(l->residual->masses, l->in, l->out, l->work);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        if (p->blocks[b].constant)
            continue;
        out = qdot_blocks_unpack(&l->solvers, b, out);
        if (p->blocks[b].n > 1)
            QDOT_TRY(qdot_blocks_factor(&l->solvers, b));
    }
    return QDOT_OK;
}

static qdot_status
begin(const qdot_ode_place *at, double unit, void *user)
{
    qdot_leading_residual *l = user;
    const size_t n = l->plan->n;

    l->unit = unit;
    for (size_t i = 0; i < 2 * n; i++)
        l->q[i * l->stride] = qdot_two_of(at->y[i], at->carry ? at->carry[i] : 0);
    for (size_t i = 0; i < n; i++)
        l->q[i * l->stride + 1] = qdot_two_scale(l->v[i * l->stride], unit);
    l->t[0] = qdot_two_of(at->t, at->t_low);
    l->t[1] = (qdot_two){unit, 0};
    if (l->forces)
        memcpy(l->ft, l->t, 2 * sizeof *l->t);
    for (int k = 0; k < 2; k++)
        qdot_tape_two_order(l->places, k);
    return factor(l, at);
}

/* Order k of the forces that hold velocities. */
static void
evaluate_forces(qdot_leading_residual *l, int k)
{
    for (size_t i = 0; i < l->plan->n && l->forces; i++) {
        l->fq[i * l->stride + (size_t)k] = l->q[i * l->stride + (size_t)k];
        l->fv[i * l->stride + (size_t)k] = l->v[i * l->stride + (size_t)k];
    }
    if (l->forces)
        qdot_tape_two_order(l->forces, k);
}

/* Coefficients k + 1 of q and k of v. */
static qdot_status
next(int k, void *user)
{
    qdot_leading_residual *l = user;
    const qdot_ode_series *series = l->series;
    const size_t n = l->plan->n, m = (size_t)k + 1;
    double nothing = 0; /* a sum of zeros, if all is finite */

    evaluate_forces(l, k - 1);
    for (size_t i = 0; i < n; i++)
        l->q[i * l->stride + m] = (qdot_two){series->x[i * series->stride + m], 0};
    qdot_tape_two_order(l->places, k + 1);
    accelerate(l, k - 1);
    for (int tries = 0; tries < most_corrections; tries++) {
        const double share = missing(l, k - 1);

        qdot_tape_two_correct(l->places, k + 1, n, l->by);
        accelerate(l, k - 1);
        if (!(share > enough))
            break;
    }
    for (size_t i = 0; i < n; i++) {
        const qdot_two x = l->q[i * l->stride + m];

        nothing += 0 * (x.hi + x.lo);
        l->v[i * l->stride + m - 1] =
            qdot_two_scale(l->kernels->mul(x, (qdot_two){(double)m, 0}), 1 / l->unit);
    }
    return nothing == 0 ? QDOT_OK
                        : qdot_fail(QDOT_EDOMAIN,
                                    "the first orders of the motion are not finite");
}

/* --- building ------------------------------------------------------------------------ */

static const qdot_two *
applied(const qdot_leading_residual *l, uint32_t at)
{
    if (at == UINT32_MAX)
        return NULL;
    if (at & QDOT_RESIDUAL_FORCES)
        return qdot_tape_two_output(l->forces, at ^ QDOT_RESIDUAL_FORCES);
    return qdot_tape_two_output(l->places, at);
}

static qdot_status
make_tapes(qdot_leading_residual *l)
{
    const size_t n = l->plan->n;
    const int most = QDOT_ODE_LEADING_MOST + 1;

    QDOT_TRY(qdot_tape_two_new(l->residual->places, most, 2 * n + 1, &l->places));
    l->stride = qdot_tape_two_stride(l->places);
    l->q = qdot_tape_two_input(l->places, 0);
    l->v = qdot_tape_two_input(l->places, n);
    l->t = qdot_tape_two_input(l->places, 2 * n);
    if (!l->residual->forces)
        return QDOT_OK;
    QDOT_TRY(qdot_tape_two_new(l->residual->forces, most, 2 * n + 1, &l->forces));
    l->fq = qdot_tape_two_input(l->forces, 0);
    l->fv = qdot_tape_two_input(l->forces, n);
    l->ft = qdot_tape_two_input(l->forces, 2 * n);
    return QDOT_OK;
}

static qdot_status
make(qdot_leading_residual *l)
{
    const qdot_residual *r = l->residual;
    const size_t n = l->plan->n;

    QDOT_TRY(make_tapes(l));
    QDOT_TRY(qdot_blocks_init(&l->solvers, l->plan, false));
    l->d = qdot_calloc(r->functions + 1, sizeof *l->d);
    l->slope = qdot_calloc(r->n_slopes + 1, sizeof *l->slope);
    l->applied = qdot_calloc(n, sizeof *l->applied);
    l->weight = qdot_calloc(r->n_weights + 1, sizeof *l->weight);
    l->x = qdot_calloc(r->functions + 1, sizeof *l->x);
    l->F = qdot_calloc(r->functions * l->stride + 1, sizeof *l->F);
    l->R = qdot_calloc(n, sizeof *l->R);
    l->by = qdot_calloc(n, sizeof *l->by);
    l->in = qdot_calloc(qdot_tape_inputs(r->masses) + 1, sizeof *l->in);
    l->out = qdot_calloc(qdot_tape_outputs(r->masses) + 1, sizeof *l->out);
    l->work = qdot_calloc(qdot_tape_work(r->masses) + 1, sizeof *l->work);
    if (!l->d || !l->slope || !l->applied || !l->weight || !l->x || !l->F || !l->R
        || !l->by || !l->in || !l->out || !l->work)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < r->functions; f++)
        l->d[f] = qdot_tape_two_output(l->places, f);
    for (size_t j = 0; j < r->n_slopes; j++)
        l->slope[j] = qdot_tape_two_output(l->places, r->slopes[j].output);
    for (size_t w = 0; w < r->n_weights; w++)
        l->weight[w] = (qdot_two){r->weights[w].w, r->weights[w].low};
    for (size_t i = 0; i < n; i++)
        l->applied[i] = applied(l, r->force[i]);
    l->leading =
        (qdot_ode_leading){.x = l->q, .stride = l->stride, .begin = begin, .next = next, .user = l};
    return QDOT_OK;
}

qdot_status
qdot_leading_residual_new(const qdot_plan *plan, const qdot_ode_series *series,
                          qdot_leading_residual **out)
{
    qdot_leading_residual *l = qdot_calloc(1, sizeof *l);
    qdot_status status;

    *out = NULL;
    if (!l)
        return QDOT_ENOMEM;
    l->plan = plan;
    l->residual = plan->residual;
    l->series = series;
    l->kernels = qdot_two_kernels_get();
    status = make(l);
    if (status != QDOT_OK) {
        qdot_leading_residual_free(l);
        return status;
    }
    *out = l;
    return QDOT_OK;
}

void
qdot_leading_residual_free(qdot_leading_residual *l)
{
    if (!l)
        return;
    qdot_tape_two_free(l->places);
    qdot_tape_two_free(l->forces);
    qdot_blocks_clear(&l->solvers);
    qdot_free(l->d);
    qdot_free(l->slope);
    qdot_free(l->applied);
    qdot_free(l->weight);
    qdot_free(l->x);
    qdot_free(l->F);
    qdot_free(l->R);
    qdot_free(l->by);
    qdot_free(l->in);
    qdot_free(l->out);
    qdot_free(l->work);
    qdot_free(l);
}

const qdot_ode_leading *
qdot_leading_residual_get(const qdot_leading_residual *l)
{
    return &l->leading;
}
