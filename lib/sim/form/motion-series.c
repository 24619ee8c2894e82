/* motion-series.c -- expands a single run in Taylor series order by order: program, linear solve, integration. */
#include "sim/form/motion-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/taylor-alike.h"
#include "sim/form/expansion.h"
#include "sim/form/momentum-rows.h"
#include "sim/form/motion-matrix.h"

enum { most_order = 47, highest = most_order - 3 };

/* Machine code is written only for blocks of at most this many unknowns. */
enum { most_coded = 6 };

struct qdot_motion_series {
    const qdot_plan *plan;
    const qdot_motion *motion;
    qdot_expansion at; /* the series program of the motion in doubles */
    qdot_motion_matrix K;
    qdot_momentum_rows momenta;
    qdot_taylor_alike *alike; /* what carries out parts that are alike, by vectors; NULL: the program is carried out */
    qdot_lanes_motion *code; /* vector machine code, as for ensembles; NULL: none */
    const char *why; /* why there is no machine code; NULL: the program tells */
    bool begun;      /* an expansion has been begun at least once */
    qdot_ode_series series;
    double unit;
    int order; /* the order of the run, of which some steps are expanded to a lower one; 0: not known */
};

/* --- one stage of the expansion -------------------------------------------------------- */

static qdot_status
stage(qdot_motion_series *s, int k)
{
    qdot_taylor *taylor = s->at.taylor;

    qdot_taylor_stage(taylor, k);
    if (k < 0)
        return QDOT_OK;
    if (k == 0)
        QDOT_TRY(qdot_motion_matrix_take_rows(&s->K));
    qdot_taylor_missing(taylor, k, s->K.by);
    qdot_motion_matrix_solve(&s->K, k);
    qdot_taylor_change(taylor, k, s->K.by);
    return QDOT_OK;
}

/* Whether the program itself computes all accelerations, so that no linear system has to be solved. */
static bool
gives_all_accelerations(const qdot_motion_series *s)
{
    return s->motion->solved.n == 0;
}

static qdot_status
check_accelerations(const qdot_motion_series *s)
{
    for (size_t i = 0; i < s->plan->n; i++)
        if (!isfinite(s->at.v[i * s->at.stride + 1]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             s->plan->names[i]);
    return s->plan->n_kept > 0 ? qdot_momentum_rows_check(&s->momenta) : QDOT_OK;
}

static qdot_status
begin_expansion(qdot_motion_series *s, double t, const double *y)
{
    if (s->alike) {
        qdot_taylor_alike_begin(s->alike, s->unit);
    } else if (gives_all_accelerations(s)) {
        qdot_taylor_begin(s->at.taylor, s->unit);
    } else {
        QDOT_TRY(qdot_motion_matrix_begin(&s->K, t, y));
        for (int k = qdot_motion_first(s->motion); k <= 0; k++)
            QDOT_TRY(stage(s, k));
    }
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_show(&s->momenta, 1);
    return check_accelerations(s);
}

static qdot_status
prepare_for_order(int p, void *user)
{
    ((qdot_motion_series *)user)->order = p;
    return QDOT_OK;
}

static qdot_status
motion_series_begin(double t, const double *y, double unit, void *user)
{
    qdot_motion_series *s = user;
    qdot_status status;

    s->unit = unit;
    qdot_taylor_set_unit(s->at.taylor, unit);
    qdot_expansion_begin(&s->at, t, y, unit);
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_draw(&s->momenta, t);
    status = begin_expansion(s, t, y);
    if (status == QDOT_EDOMAIN && !s->begun && s->plan->constraints)
        qdot_taylor_refuse_code(s->at.taylor,
                                "constraints depend on each other at the start");
    s->begun = true;
    return status;
}

/* --- orders of the expansion ----------------------------------------------------------- */

static bool
has_lanes_code(int p, void *user)
{
    const qdot_motion_series *s = user;

    return s->code && qdot_lanes_motion_orders(s->code) == p - 1;
}

static qdot_status
motion_series_extend(int p, void *user)
{
    qdot_motion_series *s = user;
    const bool as_code = qdot_taylor_is_code(s->at.taylor, p - 1);

    qdot_motion_matrix_prepare(&s->K, p > s->order ? p : s->order);
    if (as_code)
        qdot_motion_matrix_hand_over(&s->K, s->at.taylor);
    if (s->alike) {
        qdot_taylor_alike_extend(s->alike, 1, p - 1);
    } else if (as_code || gives_all_accelerations(s)) {
        qdot_taylor_extend(s->at.taylor, 1, p - 1);
    } else if (has_lanes_code(p, s)) {
        qdot_motion_matrix_hand_to_lanes(&s->K, s->code);
        qdot_taylor_set_inverses(s->at.taylor);
        qdot_lanes_motion_run(s->code, &s->unit);
    } else {
        for (int k = 1; k < p; k++)
            QDOT_TRY(stage(s, k));
    }
    if (s->plan->n_kept > 0)
        qdot_momentum_rows_show(&s->momenta, p);
    return QDOT_OK;
}

/* Find a step so short that the series' last terms are negligible; forces have two orders less than q. */
static double
find_negligible_step(int p, double step, double least, void *user)
{
    const qdot_motion_series *s = user;

    return s->alike ? qdot_taylor_alike_near(s->alike, p - 2, step, least)
                    : qdot_taylor_near(s->at.taylor, p - 2, step, least);
}

static double
noise_of_series(void *user)
{
    return qdot_saddle_solver_noise(((const qdot_motion_series *)user)->K.saddle);
}

static double
look_ahead(void *user)
{
    const qdot_motion_series *s = user;

    return qdot_saddle_solver_ahead(s->K.saddle, s->unit);
}

/* --- machine code by lanes -------------------------------------------------------------- */

static void
drop_lanes_code(void *user)
{
    qdot_motion_series *s = user;

    qdot_lanes_motion_free(s->code);
    s->code = NULL;
}

static qdot_status
write_lanes_code(int p, int most, void *user)
{
    qdot_motion_series *s = user;
    const qdot_lanes_rows rows = qdot_taylor_get_rows(s->at.taylor);

    (void)most; /* not needed: code is generated for each order by itself */
    if (has_lanes_code(p, s))
        return QDOT_OK;
    drop_lanes_code(s);
    s->why = "blocks are large, or the system does not run what was written";
    return qdot_lanes_motion_new(&rows, s->motion, p - 1, QDOT_BLOCKS_SOLVED, &s->code);
}

/* Take no stored vector machine code: earlier runs store none. */
static bool
take_no_lanes_code(int p, int most, void *user)
{
    (void)most;
    (void)p;
    (void)user;
    return false;
}

/* Whether the parts of the motion that are alike are carried out by vectors: nothing else reads their rows then. */
static bool
runs_like_parts(const qdot_plan *p, const qdot_motion *m)
{
    return m->alike && p->n_kept == 0;
}

/* --- making the series ----------------------------------------------------------------- */

/* Whether machine code may be written: all blocks are definite and have at most `most` unknowns. */
static bool
may_have_code(const qdot_plan *p, const qdot_motion *m, size_t most)
{
    for (size_t b = 0; b + 1 < m->blocks.n; b++)
        if (m->blocks.at[b + 1] - m->blocks.at[b] > most)
            return false;
    return m->blocks.n < 2 || !p->indefinite;
}

static bool
may_have_lanes_code(const qdot_plan *p, const qdot_motion *m)
{
    return qdot_lanes_may_be_code() && may_have_code(p, m, QDOT_LANES_SOLVED);
}

static bool
may_have_whole_code(const qdot_plan *p, const qdot_motion *m)
{
    return p->constraints || may_have_code(p, m, most_coded);
}

static void
choose_machine_code(qdot_motion_series *s)
{
    if (s->K.saddle)
        return;
    if (s->alike) {
        s->why = "parts that are alike are vectors of compiled functions";
        return;
    }
    s->why = "machine code is not asked for";
    if (qdot_motion_matrix_is_mass(&s->K)) {
        s->series.code = (qdot_ode_code){
            .take = take_no_lanes_code, .there = has_lanes_code, .drop = drop_lanes_code, .user = s};
        if (may_have_lanes_code(s->plan, s->motion))
            s->series.code.write = write_lanes_code;
    } else if (may_have_whole_code(s->plan, s->motion)) {
        s->series.code = qdot_expansion_code(s->at.taylor);
    } else {
        s->why = "machine code solves for few unknowns, with M definite";
    }
}

static qdot_status
make_motion_series(qdot_motion_series *s, const qdot_tape *masses, bool shaken)
{
    const qdot_plan *p = s->plan;
    const bool has_factor = !p->constraints;

    QDOT_TRY(qdot_taylor_of_motion(s->motion, shaken, most_order,
                                   has_factor ? QDOT_BLOCKS_SOLVED : 0, &s->at.taylor));
    s->at = qdot_expansion_of(s->at.taylor, p->n);
    if (runs_like_parts(p, s->motion))
        QDOT_TRY(qdot_taylor_alike_new(s->motion, s->at.taylor, &s->alike));
    QDOT_TRY(qdot_momentum_rows_init(&s->momenta, p, s->at, shaken));
    QDOT_TRY(qdot_motion_matrix_init(&s->K, p, s->motion, masses, s->at.taylor, shaken));
    s->series = (qdot_ode_series){
        .most = highest,
        .x = s->at.q,
        .stride = s->at.stride,
        .checked = p->n,
        .cost = p->expansions,
        .prepare = prepare_for_order,
        .begin = motion_series_begin,
        .extend = motion_series_extend,
        .noise = s->K.saddle ? noise_of_series : NULL,
        .ahead = s->K.saddle ? look_ahead : NULL,
        .near = qdot_taylor_may_hide(s->at.taylor) ? find_negligible_step : NULL,
        .user = s};
    choose_machine_code(s);
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
    status = make_motion_series(s, masses, shaken);
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
    qdot_taylor_alike_free(s->alike);
    qdot_taylor_free(s->at.taylor);
    qdot_momentum_rows_clear(&s->momenta);
    qdot_motion_matrix_clear(&s->K);
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

    w.vectors = runs_like_parts(p, p->motion) ? p->motion->alike->vectors : 0;
    w.code = w.vectors == 0 && may_have_whole_code(p, p->motion);
    return w;
}

qdot_work
qdot_motion_series_work_of_residual(const qdot_plan *p, const qdot_motion *m,
                                    const qdot_tape *masses)
{
    qdot_work w = qdot_work_of_motion(p, m, masses);

    w.code = may_have_lanes_code(p, m);
    return w;
}

qdot_work
qdot_motion_series_work_of_constraints(const qdot_motion_series *s)
{
    const qdot_saddle *matrix = &s->K.saddle->matrix;
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
    return qdot_motion_matrix_factored(&s->K);
}

size_t
qdot_motion_series_code(const qdot_motion_series *s, const char **why)
{
    size_t bytes;

    if (qdot_motion_matrix_is_mass(&s->K)) {
        *why = s->code ? NULL : s->why;
        return s->code ? qdot_lanes_motion_size(s->code) : 0;
    }
    bytes = qdot_taylor_code_bytes(s->at.taylor, why);
    if (bytes == 0 && !*why)
        *why = s->why;
    return bytes;
}
