/* motion-series.c -- stage by stage: the program, a block's unknowns, what they integrate to. */
#include "sim/form/motion-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/taylor-motion.h"
#include "sim/form/blocks.h"
#include "sim/form/expansion.h"
#include "sim/form/momentum-rows.h"
#include "sim/form/saddle-solver.h"
#include "tape/shake.h"

enum { most_order = 47, highest = most_order - 3 };

/* Unknowns of a larger block are not solved for by machine code, number by number. */
enum { most_coded = 6 };

/* An entry of K: where its value goes. */
typedef struct {
    double *to;
    const double *from;
} entry;

struct qdot_motion_series {
    const qdot_plan *plan;
    const qdot_motion *motion;
    qdot_expansion at; /* its program */
    qdot_saddle_solver *saddle; /* of constraints by their own coefficients, */
    int refined;                /* and orders up to this one are; else NULL, and: */
    qdot_blocks solvers;
    size_t blocks;  /* of the motion, */
    size_t *block;  /* [blocks] by their number in `solvers` */
    entry *entries; /* [n_entries] those that move; none: K is of `masses` */
    size_t n_entries;
    const qdot_tape *masses; /* NULL: K is of the entries */
    qdot_tape *shaken;       /* these, shaken; NULL: as they are */
    double *in, *out, *work; /* of `masses` */
    double *by;              /* [solved] order k of what is solved for */
    qdot_momentum_rows momenta;
    qdot_lanes_motion *code; /* by lanes; NULL: none */
    const char *why; /* there is no code for this reason; NULL: the program knows */
    bool begun;      /* once at least */
    qdot_ode_series series;
    double unit;
};

/* --- stages ---------------------------------------------------------------------------- */

static qdot_status
factor(qdot_motion_series *s)
{
    if (s->saddle)
        return qdot_saddle_solver_factor(s->saddle);
    for (size_t k = 0; k < s->blocks; k++) {
        const qdot_solver *at = s->solvers.at + s->block[k];

        if (at->n > 1 && !at->constant)
            QDOT_TRY(qdot_blocks_factor(&s->solvers, s->block[k]));
    }
    return QDOT_OK;
}

/* K of a residual, at y. */
static void
evaluate_masses(qdot_motion_series *s, double t, const double *y)
{
    const double *out = s->out;

    memcpy(s->in, y, 2 * s->plan->n * sizeof *y);
    s->in[2 * s->plan->n] = t;
    qdot_tape_eval(s->shaken ? s->shaken : s->masses, s->in, s->out, s->work);
    for (size_t b = 0; b < s->solvers.n; b++)
        if (!s->solvers.at[b].constant)
            out = qdot_blocks_unpack(&s->solvers, b, out);
}

/* Order k of what is solved for, in place of K times it. */
static void
solve(qdot_motion_series *s, int k)
{
    double *by = s->by;

    if (s->saddle && k <= s->refined)
        qdot_saddle_solve_refined(&s->saddle->matrix);
    else if (s->saddle)
        qdot_saddle_apply(&s->saddle->matrix);
    for (size_t b = 0; b < s->blocks; b++) {
        const qdot_solver *at = s->solvers.at + s->block[b];

        if (at->n == 1)
            by[0] /= at->a[0];
        else if (k <= QDOT_BLOCKS_SOLVED)
            qdot_blocks_solve(&s->solvers, s->block[b], by);
        else
            qdot_blocks_apply(&s->solvers, s->block[b], by);
        by += at->n;
    }
}

static qdot_status
stage(qdot_motion_series *s, int k)
{
    qdot_taylor *taylor = s->at.taylor;

    qdot_taylor_stage(taylor, k);
    if (k < 0)
        return QDOT_OK;
    if (k == 0 && !s->masses) {
        for (size_t i = 0; i < s->n_entries; i++)
            *s->entries[i].to = *s->entries[i].from;
        QDOT_TRY(factor(s));
    }
    qdot_taylor_missing(taylor, k, s->by);
    solve(s, k);
    qdot_taylor_change(taylor, k, s->by);
    return QDOT_OK;
}

/* Whether all is given by rows: a whole expansion is the program's. */
static bool
is_given(const qdot_motion_series *s)
{
    return s->motion->solved.n == 0;
}

static qdot_status
check(const qdot_motion_series *s)
{
    for (size_t i = 0; i < s->plan->n; i++)
        if (!isfinite(s->at.v[i * s->at.stride + 1]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             s->plan->names[i]);
    return s->plan->n_kept > 0 ? qdot_momentum_rows_check(&s->momenta) : QDOT_OK;
}

static qdot_status
expand_zero(qdot_motion_series *s, double t, const double *y)
{
    if (is_given(s)) {
        qdot_taylor_begin(s->at.taylor, s->unit);
    } else {
        if (s->masses) {
            evaluate_masses(s, t, y);
            QDOT_TRY(factor(s));
        }
        if (s->saddle)
            QDOT_TRY(qdot_saddle_solver_look(s->saddle, t, y));
        for (int k = qdot_motion_first(s->motion); k <= 0; k++)
            QDOT_TRY(stage(s, k));
    }
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_show(&s->momenta, 1);
    return check(s);
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_motion_series *s = user;
    qdot_status status;

    s->unit = unit;
    s->refined = QDOT_SADDLE_REFINED;
    qdot_taylor_set_unit(s->at.taylor, unit);
    qdot_expansion_begin(&s->at, t, y, unit);
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_draw(&s->momenta, t);
    status = expand_zero(s, t, y);
    if (status == QDOT_EDOMAIN && !s->begun && s->plan->constraints)
        qdot_taylor_refuse_code(s->at.taylor,
                                "constraints depend on each other at the start");
    s->begun = true;
    return status;
}

/* --- orders ---------------------------------------------------------------------------- */

static bool
is_code_of_lanes(int p, void *user)
{
    const qdot_motion_series *s = user;

    return s->code && qdot_lanes_motion_orders(s->code) == p - 1;
}

static void
run_lanes(const qdot_motion_series *s)
{
    for (size_t b = 0; b < s->blocks; b++) {
        const qdot_solver *at = s->solvers.at + s->block[b];

        if (at->n > 1)
            qdot_lanes_motion_set(s->code, b, at->inverse, at->m, at->a);
        else
            qdot_lanes_motion_set(s->code, b, (double[]){1 / at->a[0]}, 1, NULL);
    }
    qdot_taylor_set_inverses(s->at.taylor);
    qdot_lanes_motion_run(s->code, &s->unit);
}

/* The matrices of what the program solves for. */
static void
hand_over(const qdot_motion_series *s)
{
    for (size_t b = 0; b < s->blocks; b++) {
        const qdot_solver *at = s->solvers.at + s->block[b];
        const size_t n = at->n;
        double *to = qdot_taylor_matrices(s->at.taylor, b);

        for (size_t i = 0; i < n; i++) {
            memcpy(to + i * n, at->a + i * n, (i + 1) * sizeof *to);
            memcpy(to + (n + i) * n, at->inverse + i * at->m, n * sizeof *to);
        }
    }
}

static qdot_status
extend(int p, void *user)
{
    qdot_motion_series *s = user;
    const bool as_code = qdot_taylor_is_code(s->at.taylor, p - 1);

    if (s->saddle) {
        s->refined = p < QDOT_SADDLE_LEAST_REFINED ? 0 : QDOT_SADDLE_REFINED;
        qdot_saddle_prepare(&s->saddle->matrix);
    }
    for (size_t b = 0; b < s->blocks; b++) {
        const qdot_solver *at = s->solvers.at + s->block[b];

        if (at->n > 1 && !at->constant)
            qdot_blocks_invert(&s->solvers, s->block[b]);
    }
    if (as_code)
        hand_over(s);
    if (as_code || is_given(s))
        qdot_taylor_extend(s->at.taylor, 1, p - 1);
    else if (is_code_of_lanes(p, s))
        run_lanes(s);
    else
        for (int k = 1; k < p; k++)
            QDOT_TRY(stage(s, k));
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_show(&s->momenta, p);
    return QDOT_OK;
}

/* Orders of what leads least end two below that of q. */
static double
near(int p, double step, void *user)
{
    return qdot_taylor_near(((const qdot_motion_series *)user)->at.taylor, p - 2, step);
}

static double
noise(void *user)
{
    return qdot_saddle_solver_noise(((const qdot_motion_series *)user)->saddle);
}

static double
ahead(void *user)
{
    const qdot_motion_series *s = user;

    return qdot_saddle_solver_ahead(s->saddle, s->unit);
}

/* --- machine code by lanes -------------------------------------------------------------- */

static void
drop_lanes(void *user)
{
    qdot_motion_series *s = user;

    qdot_lanes_motion_free(s->code);
    s->code = NULL;
}

static qdot_status
write_lanes(int p, int most, void *user)
{
    qdot_motion_series *s = user;
    const qdot_lanes_rows rows = qdot_taylor_get_rows(s->at.taylor);

    (void)most; /* it is written for each order */
    if (is_code_of_lanes(p, s))
        return QDOT_OK;
    drop_lanes(s);
    s->why = "blocks are large, or the system does not run what was written";
    return qdot_lanes_motion_new(&rows, s->motion, p - 1, QDOT_BLOCKS_SOLVED, &s->code);
}

/* None is kept from earlier runs. */
static bool
take_lanes(int p, int most, void *user)
{
    (void)most;
    (void)p;
    (void)user;
    return false;
}

/* --- building -------------------------------------------------------------------------- */

/* Which blocks are solved for; their constant inverses. */
static qdot_status
make_solvers(qdot_motion_series *s, bool shaken)
{
    const qdot_motion *m = s->motion;

    QDOT_TRY(qdot_blocks_init(&s->solvers, s->plan, shaken));
    s->blocks = m->blocks.n > 0 ? m->blocks.n - 1 : 0;
    s->block = qdot_calloc(s->blocks + 1, sizeof *s->block);
    if (!s->block)
        return QDOT_ENOMEM;
    for (size_t b = 0, k = 0; b < s->blocks; b++, k++) {
        while (!s->masses && s->solvers.at[k].n == 1) /* given */
            k++;
        s->block[b] = k;
        QDOT_TRY(qdot_blocks_prepare(&s->solvers, k));
        if (s->solvers.at[k].n > 1 && s->solvers.at[k].constant)
            qdot_blocks_invert(&s->solvers, k);
    }
    return QDOT_OK;
}

/* Lower triangles: where entries of blocks that are not constant come from. */
static qdot_status
make_entries(qdot_motion_series *s)
{
    const qdot_motion *m = s->motion;
    size_t k = 0;

    s->entries = qdot_calloc(m->entries.n + 1, sizeof *s->entries);
    if (!s->entries)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m->entries.n; i++) {
        const qdot_motion_entry *x = m->entries.at + i;
        const uint32_t row = x->i > x->j ? x->i : x->j,
                       column = x->i > x->j ? x->j : x->i;
        const qdot_solver *at;

        while (x->i >= m->blocks.at[k + 1])
            k++;
        at = s->solvers.at + s->block[k];
        if (!at->constant)
            s->entries[s->n_entries++] = (entry){at->a + (row - m->blocks.at[k]) * at->n +
                                                     (column - m->blocks.at[k]),
                                                 qdot_taylor_series(s->at.taylor, x->at)};
    }
    return QDOT_OK;
}

static qdot_status
make_saddle(qdot_motion_series *s)
{
    s->saddle = qdot_calloc(1, sizeof *s->saddle);
    if (!s->saddle)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_saddle_solver_init(s->saddle, s->plan, s->at.taylor));
    s->by = s->saddle->matrix.x;
    return QDOT_OK;
}

static qdot_status
make_masses(qdot_motion_series *s, bool shaken)
{
    if (shaken)
        QDOT_TRY(qdot_tape_shake(s->masses, &s->shaken));
    s->in = qdot_calloc(2 * s->plan->n + 1, sizeof *s->in);
    s->out = qdot_calloc(qdot_tape_outputs(s->masses) + 1, sizeof *s->out);
    s->work = qdot_calloc(qdot_tape_work(s->masses) + 1, sizeof *s->work);
    return s->in && s->out && s->work ? QDOT_OK : QDOT_ENOMEM;
}

/* Whether blocks are definite and have up to `most` unknowns. */
static bool
may_be_code(const qdot_plan *p, const qdot_motion *m, size_t most)
{
    for (size_t b = 0; b + 1 < m->blocks.n; b++)
        if (m->blocks.at[b + 1] - m->blocks.at[b] > most)
            return false;
    return m->blocks.n < 2 || !p->indefinite;
}

static bool
may_be_lanes(const qdot_plan *p, const qdot_motion *m)
{
    return qdot_lanes_may_be_code() && may_be_code(p, m, QDOT_LANES_SOLVED);
}

static bool
may_be_whole(const qdot_plan *p, const qdot_motion *m)
{
    return p->constraints || may_be_code(p, m, most_coded);
}

static void
choose_code(qdot_motion_series *s)
{
    if (s->saddle)
        return;
    s->why = "machine code is not asked for";
    if (s->masses) {
        s->series.code = (qdot_ode_code){
            .take = take_lanes, .there = is_code_of_lanes, .drop = drop_lanes, .user = s};
        if (may_be_lanes(s->plan, s->motion))
            s->series.code.write = write_lanes;
    } else if (may_be_whole(s->plan, s->motion)) {
        s->series.code = qdot_expansion_code(s->at.taylor);
    } else {
        s->why = "machine code solves for few unknowns, with M definite";
    }
}

static qdot_status
make_blocks(qdot_motion_series *s, bool shaken)
{
    s->by = qdot_calloc(s->motion->solved.n + 1, sizeof *s->by);
    if (!s->by)
        return QDOT_ENOMEM;
    QDOT_TRY(make_solvers(s, shaken));
    return s->masses ? make_masses(s, shaken) : make_entries(s);
}

static qdot_status
make(qdot_motion_series *s, bool shaken)
{
    const qdot_plan *p = s->plan;
    const bool has_factor = !p->constraints;
    const bool constrained = p->constraints && s->motion == &p->constraints->motion;

    QDOT_TRY(qdot_taylor_of_motion(s->motion, shaken, most_order,
                                   has_factor ? QDOT_BLOCKS_SOLVED : 0, &s->at.taylor));
    s->at = qdot_expansion_of(s->at.taylor, p->n);
    QDOT_TRY(qdot_momentum_rows_init(&s->momenta, p, s->at, shaken));
    QDOT_TRY(constrained ? make_saddle(s) : make_blocks(s, shaken));
    s->series = (qdot_ode_series){
        .most = highest,
        .x = s->at.q,
        .stride = s->at.stride,
        .checked = p->n,
        .cost = p->expansions,
        .begin = begin,
        .extend = extend,
        .noise = constrained ? noise : NULL,
        .ahead = constrained ? ahead : NULL,
        .near = qdot_taylor_may_hide(s->at.taylor) ? near : NULL,
        .user = s};
    choose_code(s);
    return QDOT_OK;
}

qdot_status
qdot_motion_series_of_residual(const qdot_plan *plan, const qdot_motion *motion,
                               const qdot_tape *masses, bool shaken,
                               qdot_motion_series **series)
{
    qdot_motion_series *s = qdot_calloc(1, sizeof *s);
    qdot_status status;

    *series = NULL;
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->motion = motion;
    s->masses = masses;
    status = make(s, shaken);
    if (status != QDOT_OK) {
        qdot_motion_series_free(s);
        return status;
    }
    *series = s;
    return QDOT_OK;
}

qdot_status
qdot_motion_series_new(const qdot_plan *plan, bool shaken, qdot_motion_series **series)
{
    return qdot_motion_series_of_residual(plan, plan->motion, NULL, shaken, series);
}

qdot_status
qdot_motion_series_of_constraints(const qdot_plan *plan, bool shaken, qdot_motion_series **series)
{
    return qdot_motion_series_of_residual(plan, &plan->constraints->motion, NULL, shaken, series);
}

void
qdot_motion_series_free(qdot_motion_series *s)
{
    if (!s)
        return;
    qdot_lanes_motion_free(s->code);
    qdot_taylor_free(s->at.taylor);
    qdot_tape_free(s->shaken);
    qdot_momentum_rows_clear(&s->momenta);
    qdot_blocks_clear(&s->solvers);
    qdot_free(s->block);
    qdot_free(s->entries);
    if (s->saddle)
        qdot_saddle_solver_clear(s->saddle);
    else
        qdot_free(s->by);
    qdot_free(s->saddle);
    qdot_free(s->in);
    qdot_free(s->out);
    qdot_free(s->work);
    qdot_free(s);
}

void
qdot_motion_series_keep(qdot_motion_series *s, const double *hi, const double *lo)
{
    s->momenta.hi = hi;
    s->momenta.lo = lo;
}

const qdot_ode_series *
qdot_motion_series_get(const qdot_motion_series *s)
{
    return &s->series;
}

const double *
qdot_motion_series_output(const qdot_motion_series *s, size_t i)
{
    return qdot_taylor_output(s->at.taylor, i);
}

qdot_work
qdot_motion_series_work(const qdot_plan *p)
{
    qdot_work w = qdot_work_of_motion(p, p->motion, p->bordered ? p->bordered : p->tape);

    w.code = may_be_whole(p, p->motion);
    return w;
}

qdot_work
qdot_motion_series_work_of_residual(const qdot_plan *p, const qdot_motion *m,
                                    const qdot_tape *masses)
{
    qdot_work w = qdot_work_of_motion(p, m, masses);

    w.code = may_be_lanes(p, m);
    return w;
}

qdot_work
qdot_motion_series_work_of_constraints(const qdot_motion_series *s)
{
    const qdot_saddle *matrix = &s->saddle->matrix;
    const double all = (double)s->motion->solved.n;

    return (qdot_work){.coordinates = (double)s->plan->n,
                       .length = (double)qdot_taylor_length(s->at.taylor),
                       .convolutions = qdot_taylor_convolutions(s->at.taylor),
                       .calls = (double)qdot_tape_calls(s->plan->tape),
                       .unknowns = all,
                       .squares = all * all,
                       .filled = matrix->patterned ? (double)matrix->sparse.filled : all * all,
                       .inverted = matrix->inverse != NULL};
}

size_t
qdot_motion_series_factored(const qdot_motion_series *s)
{
    return s->saddle ? s->saddle->matrix.factored : s->solvers.factored;
}

size_t
qdot_motion_series_code(const qdot_motion_series *s, const char **why)
{
    size_t bytes;

    if (s->masses) {
        *why = s->code ? NULL : s->why;
        return s->code ? qdot_lanes_motion_size(s->code) : 0;
    }
    bytes = qdot_taylor_code_bytes(s->at.taylor, why);
    if (bytes == 0 && !*why)
        *why = s->why;
    return bytes;
}
