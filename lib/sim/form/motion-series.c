/* motion-series.c -- stage by stage: the program, a block's unknowns, what they integrate to. */
#include "sim/form/motion-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/taylor-motion.h"
#include "sim/form/blocks.h"
#include "sim/form/expansion.h"
#include "tape/shake.h"

enum { most_order = 44 };

struct qdot_motion_series {
    const qdot_plan *plan;
    const qdot_motion *motion;
    const qdot_tape *masses;
    qdot_tape *shaken;       /* these, shaken; NULL: as they are */
    qdot_expansion at;       /* its program */
    qdot_lanes_motion *code; /* NULL: kernels run */
    const char *why;         /* for this reason */
    qdot_blocks solvers;
    qdot_ode_series series;
    double unit;
    const double **E;        /* [n] series of the equations, block by block */
    double *by;              /* [n] order k of what is solved for */
    double *in, *out, *work; /* of `masses` */
};

/* --- stages ---------------------------------------------------------------------------- */

/* Order k of the unknowns. */
static void
stage(qdot_motion_series *s, int k)
{
    const double *const *E = s->E;
    double *by = s->by;

    qdot_taylor_stage(s->at.taylor, k);
    if (k < 0)
        return;
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const qdot_solver *at = s->solvers.at + b;
        const size_t n = s->plan->blocks[b].n;

        for (size_t i = 0; i < n; i++)
            at->x[i] = -E[i][k];
        if (n == 1)
            at->x[0] /= at->a[0];
        else if (k <= QDOT_BLOCKS_SOLVED)
            qdot_blocks_solve(&s->solvers, b);
        else
            qdot_blocks_apply(&s->solvers, b);
        memcpy(by, at->x, n * sizeof *by);
        by += n;
        E += n;
    }
    qdot_taylor_change(s->at.taylor, k, s->by);
}

static qdot_status
factor(qdot_motion_series *s, double t, const double *y)
{
    const qdot_plan *p = s->plan;
    const double *out = s->out;

    memcpy(s->in, y, 2 * p->n * sizeof *y);
    s->in[2 * p->n] = t;
    qdot_tape_eval(s->shaken ? s->shaken : s->masses, s->in, s->out, s->work);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        if (p->blocks[b].constant)
            continue;
        out = qdot_blocks_unpack(&s->solvers, b, out);
        if (p->blocks[b].n > 1)
            QDOT_TRY(qdot_blocks_factor(&s->solvers, b));
    }
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_motion_series *s = user;
    const size_t n = s->plan->n;

    s->unit = unit;
    qdot_taylor_set_unit(s->at.taylor, unit);
    qdot_expansion_begin(&s->at, t, y, unit);
    QDOT_TRY(factor(s, t, y));
    for (int k = qdot_motion_first(s->motion); k <= 0; k++)
        stage(s, k);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(s->at.v[i * s->at.stride + 1]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             s->plan->names[i]);
    return QDOT_OK;
}

static bool
is_code(int p, void *user)
{
    const qdot_motion_series *s = user;

    return s->code && qdot_lanes_motion_orders(s->code) == p - 1;
}

static void
run_code(const qdot_motion_series *s)
{
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const qdot_solver *at = s->solvers.at + b;

        if (s->plan->blocks[b].n > 1)
            qdot_lanes_motion_set(s->code, b, at->inverse, at->m, at->a);
        else
            qdot_lanes_motion_set(s->code, b, (double[]){1 / at->a[0]}, 1, NULL);
    }
    qdot_taylor_set_inverses(s->at.taylor);
    qdot_lanes_motion_run(s->code, &s->unit);
}

static qdot_status
extend(int p, void *user)
{
    qdot_motion_series *s = user;

    for (size_t b = 0; b < s->plan->structure.blocks; b++)
        if (s->plan->blocks[b].n > 1 && !s->plan->blocks[b].constant)
            qdot_blocks_invert(&s->solvers, b);
    if (is_code(p, s)) {
        run_code(s);
        return QDOT_OK;
    }
    for (int k = 1; k < p; k++)
        stage(s, k);
    return QDOT_OK;
}

/* --- machine code ---------------------------------------------------------------------- */

static void
drop_code(void *user)
{
    qdot_motion_series *s = user;

    qdot_lanes_motion_free(s->code);
    s->code = NULL;
}

static qdot_status
write_code(int p, int most, void *user)
{
    qdot_motion_series *s = user;
    const qdot_lanes_rows rows = qdot_taylor_get_rows(s->at.taylor);

    (void)most; /* it is written for each order */
    if (is_code(p, s))
        return QDOT_OK;
    drop_code(s);
    s->why = "blocks are large, or the system does not run what was written";
    return qdot_lanes_motion_new(&rows, s->motion, p - 1, QDOT_BLOCKS_SOLVED, &s->code);
}

/* None is kept from earlier runs. */
static bool
take_code(int p, int most, void *user)
{
    (void)most;
    (void)p;
    (void)user;
    return false;
}

/* --- building -------------------------------------------------------------------------- */

/* Orders of what leads least end two below that of q. */
static double
near(int p, double step, void *user)
{
    return qdot_taylor_near(((const qdot_motion_series *)user)->at.taylor, p - 2, step);
}

/* Nanoseconds: nineteen scenes at orders 8 to 30, of 2 to 16 coordinates, to 20 %. */
static void
estimate_cost(qdot_motion_series *s)
{
    const qdot_plan *p = s->plan;
    double *c = s->series.cost, *w = s->series.code.cost, squares = 0, cubes = 0;
    const double length = (double)qdot_taylor_length(s->at.taylor);
    const double convolutions = qdot_taylor_convolutions(s->at.taylor);

    for (size_t b = 0; b < p->structure.blocks; b++) {
        const double n = (double)p->blocks[b].n;

        squares += n > 1 ? n * n : 0;
        cubes += n > 1 ? n * n * n : 0;
    }
    c[0] = 180 + 60 * (double)qdot_tape_calls(s->masses) +
           1.1 * (double)qdot_tape_operations(s->masses) + 11 * length + 0.5 * cubes;
    c[1] = 190 + 3.2 * length + 2.7 * squares;
    c[2] = 0.17 * convolutions;
    if (!s->series.code.write)
        return;
    w[0] = c[0];
    w[1] = 15 + 0.4 * length + 1.4 * squares;
    w[2] = 0.15 * convolutions;
}

static qdot_status
make(qdot_motion_series *s, bool shaken)
{
    const qdot_plan *p = s->plan;
    const size_t n = p->n;
    bool small = qdot_lanes_may_be_code() && !p->indefinite;

    QDOT_TRY(qdot_taylor_of_motion(s->motion, shaken, most_order, &s->at.taylor));
    if (shaken)
        QDOT_TRY(qdot_tape_shake(s->masses, &s->shaken));
    s->at = qdot_expansion_of(s->at.taylor, n);
    s->E = qdot_calloc(n, sizeof *s->E);
    s->by = qdot_calloc(n, sizeof *s->by);
    s->in = qdot_calloc(2 * n + 1, sizeof *s->in);
    s->out = qdot_calloc(qdot_tape_outputs(s->masses) + 1, sizeof *s->out);
    s->work = qdot_calloc(qdot_tape_work(s->masses) + 1, sizeof *s->work);
    if (!s->E || !s->by || !s->in || !s->out || !s->work)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        s->E[i] = qdot_taylor_series(s->at.taylor, s->motion->equations.at[i]);
    QDOT_TRY(qdot_blocks_init(&s->solvers, p, shaken));
    for (size_t b = 0; b < p->structure.blocks; b++)
        if (p->blocks[b].n > 1) {
            QDOT_TRY(qdot_blocks_prepare(&s->solvers, b));
            if (p->blocks[b].constant)
                qdot_blocks_invert(&s->solvers, b);
            small = small && p->blocks[b].n <= QDOT_LANES_SOLVED;
        }
    s->series = (qdot_ode_series){
        .most = most_order - 4,
        .x = s->at.q,
        .stride = s->at.stride,
        .checked = n,
        .code = {.worth = 1500,
                 .write = small ? write_code : NULL,
                 .take = take_code,
                 .there = is_code,
                 .drop = drop_code,
                 .user = s},
        .begin = begin,
        .extend = extend,
        .near = qdot_taylor_has_exponentials(s->at.taylor) ? near : NULL,
        .user = s};
    estimate_cost(s);
    return QDOT_OK;
}

qdot_status
qdot_motion_series_new(const qdot_plan *plan, const qdot_motion *motion,
                       const qdot_tape *masses, bool shaken, qdot_motion_series **series)
{
    qdot_motion_series *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *series = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->motion = motion;
    s->masses = masses;
    s->why = "machine code is not asked for";
    status = make(s, shaken);
    if (status != QDOT_OK) {
        qdot_motion_series_free(s);
        return status;
    }
    *series = s;
    return QDOT_OK;
}

void
qdot_motion_series_free(qdot_motion_series *s)
{
    if (!s)
        return;
    qdot_lanes_motion_free(s->code);
    qdot_taylor_free(s->at.taylor);
    qdot_tape_free(s->shaken);
    if (s->solvers.plan)
        qdot_blocks_clear(&s->solvers);
    qdot_free(s->E);
    qdot_free(s->by);
    qdot_free(s->in);
    qdot_free(s->out);
    qdot_free(s->work);
    qdot_free(s);
}

const qdot_ode_series *
qdot_motion_series_get(const qdot_motion_series *s)
{
    return &s->series;
}

size_t
qdot_motion_series_factored(const qdot_motion_series *s)
{
    return s->solvers.factored;
}

size_t
qdot_motion_series_code(const qdot_motion_series *s, const char **why)
{
    *why = s->code ? NULL : s->why;
    return s->code ? qdot_lanes_motion_size(s->code) : 0;
}
