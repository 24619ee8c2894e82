/* bind.c -- tape, then solve: the right-hand side and its Jacobian. */
#include "sim/bind.h"

#include <math.h>
#include <string.h>

#include "sim/blocks.h"
#include "sim/direct.h"
#include "sim/constrained.h"
#include "sim/shifted.h"
#include "sim/constrained-series.h"
#include "tape/shake.h"

struct qdot_bind {
    const qdot_plan *plan;
    qdot_tape *tape, *jacobian; /* shaken copies; else NULL */
    qdot_blocks blocks;
    qdot_constrained *held;            /* of a plan with constraints: in place of the blocks */
    qdot_direct *direct;        /* where the equations are smooth, one of the two: */
    qdot_shifted *shifted;
    qdot_constrained_series *tied;            /* or, of a plan with constraints: */
    const qdot_ode_series *series; /* its callbacks; else NULL */
    double *in;                 /* [3n + 1] q, q', t, q'' */
    double *out, *work;         /* of either tape */
};

static const qdot_tape *
equations(const qdot_bind *b)
{
    return b->tape ? b->tape : b->plan->tape;
}

static const qdot_tape *
slopes(const qdot_bind *b)
{
    return b->jacobian ? b->jacobian : b->plan->jacobian;
}

void
qdot_bind_free(qdot_bind *b)
{
    if (!b)
        return;
    qdot_blocks_clear(&b->blocks);
    qdot_constrained_free(b->held);
    qdot_direct_free(b->direct);
    qdot_shifted_free(b->shifted);
    qdot_constrained_series_free(b->tied);
    qdot_tape_free(b->tape);
    qdot_tape_free(b->jacobian);
    qdot_free(b->in);
    qdot_free(b->out);
    qdot_free(b->work);
    qdot_free(b);
}

/* --- the system --------------------------------------------------------------------- */

static void
load(const qdot_bind *b, double t, const double *y)
{
    size_t n = b->plan->n;

    memcpy(b->in, y, 2 * n * sizeof *y);
    b->in[2 * n] = t;
}

/* q'' at what is loaded, into a [n]. */
static qdot_status
accelerations(qdot_bind *b, double *a)
{
    const qdot_plan *p = b->plan;
    const double *out = b->out;

    if (b->held)
        return qdot_constrained_solve(b->held, b->in[2 * p->n], b->in, a, NULL);
    qdot_tape_eval(equations(b), b->in, b->out, b->work);
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;
        const double *x = b->blocks.at[k].x;

        if (block->n == 1) {
            a[block->index[0]] = *out++;
            continue;
        }
        memcpy(b->blocks.at[k].x, out, block->n * sizeof *out);
        out += block->n;
        if (!block->constant) {
            out = qdot_blocks_unpack(&b->blocks, k, out);
            QDOT_TRY(qdot_blocks_factor(&b->blocks, k));
        }
        qdot_blocks_solve(&b->blocks, k);
        for (size_t i = 0; i < block->n; i++)
            a[block->index[i]] = x[i];
    }
    for (size_t i = 0; i < p->n; i++)
        if (!isfinite(a[i]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             p->names[i]);
    return QDOT_OK;
}

static qdot_status
rhs(double t, const double *y, double *dydt, void *user)
{
    qdot_bind *b = user;
    size_t n = b->plan->n;

    load(b, t, y);
    memcpy(dydt, y + n, n * sizeof *y);
    return accelerations(b, dydt + n);
}

/* Column `column` of the right-hand sides in b->out, solved into a [n]. */
static void
slope_column(const qdot_bind *b, uint32_t column, double *a)
{
    const qdot_plan *p = b->plan;

    memset(a, 0, p->n * sizeof *a);
    for (size_t i = 0; i < p->n_slopes; i++)
        if (p->slopes[i].column == column)
            a[p->slopes[i].row] = b->out[i];
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;
        double *x = b->blocks.at[k].x;

        for (size_t i = 0; i < block->n; i++)
            x[i] = a[block->index[i]];
        if (block->n == 1)
            x[0] /= b->blocks.at[k].a[0];
        else
            qdot_blocks_solve(&b->blocks, k);
        for (size_t i = 0; i < block->n; i++)
            a[block->index[i]] = x[i];
    }
}

static qdot_status
jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    qdot_bind *b = user;
    const qdot_plan *p = b->plan;
    size_t n = p->n;
    double *column = b->in + 2 * n + 1; /* free again once the tape has run */
    const double *out;

    load(b, t, y);
    QDOT_TRY(accelerations(b, b->in + 2 * n + 1));
    qdot_tape_eval(slopes(b), b->in, b->out, b->work);
    out = b->out + p->n_slopes;
    for (size_t k = 0; k < p->structure.blocks; k++) {
        if (p->blocks[k].constant)
            continue;
        out = qdot_blocks_unpack(&b->blocks, k, out);
        if (p->blocks[k].n > 1)
            QDOT_TRY(qdot_blocks_factor(&b->blocks, k));
    }
    memset(dfdy, 0, 4 * n * n * sizeof *dfdy);
    memset(dfdt, 0, 2 * n * sizeof *dfdt);
    for (size_t i = 0; i < n; i++)
        dfdy[i * 2 * n + n + i] = 1;
    for (uint32_t j = 0; j <= 2 * n; j++) {
        slope_column(b, j, column);
        for (size_t i = 0; i < n; i++)
            *(j < 2 * n ? &dfdy[(n + i) * 2 * n + j] : &dfdt[n + i]) = column[i];
    }
    return QDOT_OK;
}

static qdot_status
project(double t, double *y, double *carry, double *moved, void *user)
{
    return qdot_constrained_project(t, y, carry, moved, ((qdot_bind *)user)->held);
}

qdot_constrained *
qdot_bind_held(qdot_bind *b)
{
    return b->held;
}

qdot_ode_system
qdot_bind_system(qdot_bind *b)
{
    return (qdot_ode_system){
        .n = 2 * b->plan->n,
        .rhs = rhs,
        .jacobian = b->plan->jacobian ? jacobian : NULL,
        .user = b,
        .series = b->series,
        .project = b->held && b->plan->treatment == QDOT_RUN_PROJECT ? project : NULL,
    };
}

qdot_status
qdot_bind_check(qdot_bind *b, double t, double *y, double *low)
{
    const qdot_plan *p = b->plan;
    qdot_tape *masses = NULL;
    qdot_status status = QDOT_OK;
    qdot_expr M = QDOT_NIL;
    double *work = NULL, m;

    if (b->held) {
        status = qdot_constrained_start(b->held, t, y, low);
        return status == QDOT_EDOMAIN ? QDOT_OK : status; /* as below */
    }
    load(b, t, y);
    for (size_t k = 0; k < p->structure.blocks && status == QDOT_OK; k++) {
        const qdot_plan_block *block = p->blocks + k;

        if (block->n > 1)
            continue; /* the solvers look themselves */
        M = p->M[block->index[0] * (p->n + 1)];
        QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &M, &masses));
        work = qdot_malloc((qdot_tape_work(masses) + 1) * sizeof *work);
        if (work)
            qdot_tape_eval(masses, b->in, &m, work);
        status = work ? QDOT_OK : QDOT_ENOMEM;
        qdot_free(work);
        qdot_tape_free(masses);
        if (status == QDOT_OK && (p->indefinite ? m == 0 : !(m > 0)))
            status = qdot_blocks_singular(p, block, 0);
    }
    if (status == QDOT_OK) {
        status = accelerations(b, b->in + 2 * p->n + 1);
        if (status == QDOT_EDOMAIN) /* the run itself says so, with its time */
            status = QDOT_OK;
    }
    return status;
}

size_t
qdot_bind_factored(const qdot_bind *b)
{
    return b->blocks.factored + (b->held ? qdot_constrained_factored(b->held) : 0)
           + (b->tied ? qdot_constrained_series_factored(b->tied) : 0) + (b->direct ? qdot_direct_factored(b->direct) : 0)
           + (b->shifted ? qdot_shifted_factored(b->shifted) : 0);
}

/* With constraints. */
static qdot_status
make_held(qdot_bind *b, bool shaken)
{
    QDOT_TRY(qdot_constrained_new(b->plan, shaken, &b->held));
    if (!b->plan->smooth)
        return QDOT_OK;
    QDOT_TRY(qdot_constrained_series_new(b->plan, shaken, &b->tied));
    b->series = qdot_constrained_series_get(b->tied);
    return QDOT_OK;
}

static qdot_status
make(qdot_bind *b, bool shaken)
{
    const qdot_plan *p = b->plan;
    const qdot_tape *tapes[2] = {p->tape, p->jacobian};
    size_t out = 0, work = 0;

    for (int i = 0; i < 2; i++)
        if (tapes[i]) {
            out = qdot_tape_outputs(tapes[i]) > out ? qdot_tape_outputs(tapes[i]) : out;
            work = qdot_tape_work(tapes[i]) > work ? qdot_tape_work(tapes[i]) : work;
        }
    b->in = qdot_calloc(3 * p->n + 1, sizeof *b->in);
    b->out = qdot_calloc(out + 1, sizeof *b->out);
    b->work = qdot_calloc(work + 1, sizeof *b->work);
    if (!b->in || !b->out || !b->work)
        return QDOT_ENOMEM;
    if (p->constraints)
        return make_held(b, shaken);
    if (shaken) {
        QDOT_TRY(qdot_tape_shake(p->tape, &b->tape));
        if (p->jacobian)
            QDOT_TRY(qdot_tape_shake(p->jacobian, &b->jacobian));
    }
    QDOT_TRY(qdot_blocks_init(&b->blocks, p, shaken));
    if (!p->smooth)
        return QDOT_OK;
    if (p->residual) {
        QDOT_TRY(qdot_shifted_new(p, p->residual, shaken, &b->shifted));
        b->series = qdot_shifted_series(b->shifted);
    } else {
        QDOT_TRY(qdot_direct_new(p, shaken, &b->direct));
        b->series = qdot_direct_series(b->direct);
    }
    return QDOT_OK;
}

qdot_status
qdot_bind_new(const qdot_plan *plan, bool shaken, qdot_bind **bind)
{
    qdot_bind *b = qdot_calloc(1, sizeof *b);
    qdot_status status;

    *bind = NULL;
    if (!b)
        return QDOT_ENOMEM;
    b->plan = plan;
    status = make(b, shaken);
    if (status != QDOT_OK) {
        qdot_bind_free(b);
        b = NULL;
    }
    *bind = b;
    return status;
}
