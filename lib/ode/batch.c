/* batch.c -- Taylor-series steps of many independent solutions at once, one in each vector lane. */
#include "ode/batch.h"
#include "ode/run.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/kinds.h"
#include "num/series.h"
#include "ode/step-decisions.h"

enum { L = QDOT_LANES, line = 64 };

static const int64_t max_steps = 50000000;

/* Data of all lanes of a group, one solution in each; counts and flags are integers, a flag has all bits set or none. */
typedef struct {
    _Alignas(64) double t[L], t1[L];
    double direction[L], unit[L], old_unit[L];
    double end[L], h[L], most[L]; /* end and length of the step being tried; largest length allowed at present */
    double moved[L];                  /* how far a projection onto the constraints moved the end of the step */
    double s[L], way[L], now[L]; /* s: step in units of time, with t1_low; way, now: without it, in the unit before and after */
    int64_t active[L], tried[L]; /* flags: the lane has a solution; the step of this solution is being checked */
    int64_t good[L], defined[L];      /* flags: the step is accepted; the equations are defined at its end */
    int64_t ended[L], ends[L];        /* the last series ended, and its step was good; the one
                                         being tried is such a one */
    int64_t tries[L], rescales[L];    /* counts of attempts and of changes of unit since the last accepted step */
    int64_t steps[L], rejected[L];    /* counts of the solution in the lane */
    size_t member[L];
} lanes;

typedef struct {
    bool (*choose)(lanes *a, const double *upper, const double *lower, double log_aim,
                   double *log_step, int64_t *left);
    bool (*accept)(lanes *a, int64_t most_steps, int64_t *taken, int64_t *odd);
} decisions;

#define BATCH_BODY "ode/batch.def"
#include "num/batch-kinds.def"

static const decisions *const kinds[] = {
    &portable_decisions,
#ifdef QDOT_X86_KINDS
    &avx2_decisions,
    &avx512_decisions,
#endif
};

typedef struct {
    lanes at;
    const qdot_ode_batch *system;
    const qdot_batch_kernels *kernels;
    const decisions *decide;
    qdot_batch_run *run;
    size_t n, moving, waiting; /* number of components; how many, the first, vary; next solution without a lane */
    double *y, *carry, *next, *next_carry, *value, *slope, *first; /* [n groups] */
    int64_t most_steps;
    double log_aim; /* log2 of the error at which a step aims, as in taylor.c */
    /* By order: 1/k; log2 of how large terms may be, of the upper half beside that aim, of the
     * lower one; 0. */
    double inverse[QDOT_SERIES_MOST + 1], upper[QDOT_SERIES_MOST + 1];
    double lower[QDOT_SERIES_MOST + 1], nothing[QDOT_SERIES_MOST + 1];
} batch;

/* --- solutions begin and end in lanes ----------------------------------------------- */

/* Put the next solution into lane l at its start; if there is none the lane is ignored from now on. */
static void
enter_lane(batch *b, size_t l)
{
    qdot_batch_run *run = b->run;
    lanes *a = &b->at;

    a->tried[l] = a->active[l] = 0;
    while (b->waiting < run->members) {
        size_t m = b->waiting++;

        run->results[m] = (qdot_batch_result){.t = run->t0[m]};
        if (run->t0[m] == run->t1[m])
            continue;
        a->member[l] = m;
        a->active[l] = -1;
        a->direction[l] = a->unit[l] = run->t1[m] < run->t0[m] ? -1 : 1;
        a->t[l] = run->t0[m];
        a->t1[l] = run->t1[m];
        a->most[l] = INFINITY;
        a->ended[l] = a->ends[l] = 0;
        a->tries[l] = a->rescales[l] = a->steps[l] = a->rejected[l] = 0;
        for (size_t i = 0; i < b->n; i++) {
            b->y[i * L + l] = run->y[m * b->n + i];
            b->carry[i * L + l] = 0;
        }
        if (b->system->take)
            b->system->take(l, m, b->system->user);
        return;
    }
}

static void
leave_lane(batch *b, size_t l, qdot_batch_outcome outcome)
{
    const lanes *a = &b->at;

    b->run->results[a->member[l]] = (qdot_batch_result){.outcome = outcome,
                                                        .t = a->t[l],
                                                        .steps = (size_t)a->steps[l],
                                                        .rejected = (size_t)a->rejected[l]};
    for (size_t i = 0; i < b->n; i++)
        b->run->y[a->member[l] * b->n + i] = b->y[i * L + l];
    enter_lane(b, l);
}

/* --- steps of all lanes ------------------------------------------------------------- */

static void
begin_series_in_lanes(batch *b)
{
    lanes *a = &b->at;
    double t[L], *y = b->value; /* an array that is not in use here */

    memcpy(t, a->t, sizeof t);
    memcpy(y, b->y, b->n * L * sizeof *y);
    b->kernels->blend(1, a->tried, a->end, t);
    b->kernels->blend(b->moving, a->tried, b->next, y);
    b->system->begin(t, y, a->unit, b->system->user);
}

static qdot_batch_series
series_of_lanes(const batch *b)
{
    return (qdot_batch_series){b->moving, b->system->checked, b->system->stride, b->system->x};
}

static const double *
address_of_coefficient(const batch *b, size_t i, int k)
{
    return b->system->x + (i * b->system->stride + (size_t)k) * L;
}

/* Check the steps of all lanes by the equations at their ends, as `confirms` in taylor.c does for one solution. */
static void
confirm(batch *b)
{
    lanes *a = &b->at;
    const qdot_batch_series series = series_of_lanes(b);
    const qdot_batch_defect defect = {.slope = b->slope,
                                      .first = b->first,
                                      .next = b->next,
                                      .steps = a->way,
                                      .now = a->now,
                                      .share = qdot_step_share(b->run->order, b->run->tol),
                                      .rounding = qdot_step_rounding};

    b->kernels->confirm(&series, &defect, a->good, a->defined);
    for (size_t l = 0; b->system->project && l < L; l++)
        if (!(a->moved[l] <= qdot_step_most_moved(b->run->tol)))
            a->good[l] = 0;
}

/* Return lane l to the start of its step, to try a quarter of the length. */
static void
reject(batch *b, size_t l)
{
    lanes *a = &b->at;

    a->rejected[l]++;
    a->most[l] = qdot_step_quarter * fabs(a->h[l]);
    a->ended[l] = 0;
    a->unit[l] = a->direction[l] * qdot_step_unit(a->most[l]);
    if (++a->tries[l] > QDOT_STEP_ATTEMPTS || a->most[l] < qdot_step_floor(a->t[l]))
        leave_lane(b, l, QDOT_BATCH_STUCK);
}

/* Accept or reject the steps tried by the series begun at their ends. Returns whether some lane
 * must begin anew. */
static bool
judge_lanes(batch *b)
{
    lanes *a = &b->at;
    int64_t taken[L], odd[L];
    bool again;

    confirm(b);
    again = b->decide->accept(a, b->most_steps, taken, odd);
    b->kernels->blend(b->moving, taken, b->next, b->y);
    b->kernels->blend(b->moving, taken, b->next_carry, b->carry);
    for (size_t l = 0; b->system->taken && l < L; l++)
        if (taken[l] && b->system->taken(l, b->system->looker)) {
            leave_lane(b, l, QDOT_BATCH_LEFT);
            odd[l] = 0;
            again = true; /* repeat, since the new solution in the lane is to be checked, too */
        }
    for (size_t l = 0; again && l < L; l++) {
        if (!odd[l])
            continue;
        if (!a->tried[l])
            leave_lane(b, l, QDOT_BATCH_UNDEFINED);
        else if (!taken[l])
            reject(b, l);
        else
            leave_lane(b, l, a->t[l] == a->t1[l] ? QDOT_BATCH_DONE : QDOT_BATCH_LIMIT);
    }
    memset(a->tried, 0, sizeof a->tried);
    return again;
}

/* Try a step of at most the length h in lane l; its end is rounded to a double, or to t1 if that is near. */
static void
try_step_in_lane(batch *b, size_t l, double h)
{
    lanes *a = &b->at;
    const double rest = a->direction[l] * (a->t1[l] - a->t[l]);
    double end;

    a->ends[l] = isinf(h) ? -1 : 0;
    if (isinf(h)) /* the series may be the whole solution: another place confirms it before the rest is passed over */
        h = a->ended[l] ? rest : qdot_step_places[0] * rest;
    h = qdot_smaller(h, a->most[l]);
    a->end[l] = end = qdot_step_end(a->t[l], a->t1[l], a->direction[l], h, false);
    a->h[l] = h = end - a->t[l];
    if (end != a->t1[l] && qdot_step_is_too_short(a->t[l], fabs(h))) {
        leave_lane(b, l, QDOT_BATCH_STUCK);
        return;
    }
    a->tried[l] = -1;
    a->s[l] = (end == a->t1[l] ? h + b->run->t1_low : h) / a->unit[l];
    a->way[l] = h / a->unit[l];
    a->unit[l] = qdot_step_unit(h);
    a->now[l] = h / a->unit[l];
}

/* Find log2 of the step of each lane, in units, from both halves of the series; see `log_step` in taylor.c. */
static void
log_steps(const batch *b, const double *weight, double *upper, double *lower)
{
    const qdot_batch_series series = series_of_lanes(b);
    const int p = b->run->order;

    b->kernels->log_steps(&series, p / 2 + 1, p, weight, b->inverse, b->upper, upper);
    b->kernels->log_steps(&series, 2, p / 2, weight, b->inverse, b->lower, lower);
}

/* For lane l, whose step does not follow directly from the series: another unit, or a possible
 * step. */
static void
choose_step_of_lane(batch *b, size_t l, double step, const double *weight)
{
    const int p = b->run->order;
    lanes *a = &b->at;
    double far = step;

    if (isnan(step)) {
        far = qdot_step_overflow(a->rescales[l]);
    } else if (isinf(step)) {
        const qdot_batch_series series = series_of_lanes(b);
        double whole[L];

        b->kernels->log_steps(&series, 1, p, weight, b->inverse, b->nothing, whole);
        far = fmax(0, whole[l] + b->log_aim / p);
    }
    if (fabs(far) > QDOT_STEP_UNIT_FAR && !isinf(far) && a->rescales[l] < QDOT_STEP_UNITS) {
        a->unit[l] = qdot_step_other_unit(a->unit[l], far);
        a->rescales[l]++;
        if (!(fabs(a->unit[l]) >= DBL_MIN && isfinite(a->unit[l])))
            leave_lane(b, l, QDOT_BATCH_STUCK);
    } else if (isnan(step)) {
        a->h[l] = a->unit[l]; /* the start point itself is good: only a step beyond it fails */
        reject(b, l);
    } else
        try_step_in_lane(b, l, fabs(a->unit[l]) * qdot_rough_exp2(step));
}

/* Choose the step of each lane from its series, or a new unit of time for the series. */
static void
choose_steps_of_lanes(batch *b)
{
    double upper[L], lower[L], steps[L], *weight = b->value; /* an array that is not in use here */
    int64_t left[L];

    b->kernels->weights(b->moving, b->y, weight);
    log_steps(b, weight, upper, lower);
    if (!b->decide->choose(&b->at, upper, lower, b->log_aim / b->run->order, steps, left))
        return;
    for (size_t l = 0; l < L; l++)
        if (left[l])
            choose_step_of_lane(b, l, steps[l], weight);
}

/* Evaluate the state at the end of each lane's step, and the time derivatives there that verify the step. */
static void
evaluate_ends_in_lanes(batch *b)
{
    const qdot_ode_batch *system = b->system;
    const qdot_batch_series series = series_of_lanes(b);

    b->kernels->tails(&series, b->run->order, b->at.s, b->value, b->slope);
    b->kernels->advance(&series, b->at.s, b->at.old_unit, b->value,
                        (qdot_batch_sum){b->y, b->carry},
                        (qdot_batch_sum){b->next, b->next_carry});
    for (size_t i = system->checked; i < b->moving; i++)
        memcpy(b->first + i * L, address_of_coefficient(b, i, 1), L * sizeof *b->first);
    if (system->project) {
        double t[L];

        memcpy(t, b->at.t, sizeof t);
        b->kernels->blend(1, b->at.tried, b->at.end, t);
        memcpy(b->next + b->moving * L, b->y + b->moving * L, system->still * L * sizeof *b->y);
        system->project(t, b->next, b->next_carry, b->at.moved, system->user);
    }
}

/* Shorten steps that would go over a part of f that is not seen where they begin: near_length of
 * taylor-length.c. */
static void
shorten_near_hidden_parts(batch *b)
{
    lanes *a = &b->at;
    double s[L], least[L], near[L];

    if (!b->system->near)
        return;
    for (size_t l = 0; l < L; l++) {
        s[l] = a->tried[l] ? fabs(a->h[l] / a->old_unit[l]) : NAN;
        least[l] = qdot_step_narrowest * fabs(a->t[l] / a->old_unit[l]);
    }
    b->system->near(b->run->order, s, least, near, b->system->user);
    for (size_t l = 0; l < L; l++) {
        if (!(near[l] < s[l]))
            continue;
        a->unit[l] = a->old_unit[l];
        a->tried[l] = 0;
        try_step_in_lane(b, l, near[l] * fabs(a->old_unit[l]));
    }
}

/* Pass the steps that the lanes are about to try to the caller's callback. */
static qdot_status
show_steps_to_caller(const batch *b)
{
    const qdot_ode_batch *system = b->system;
    const lanes *a = &b->at;

    for (size_t l = 0; system->tried && l < L; l++) {
        const qdot_batch_step step = {.lane = l,
                                      .member = a->member[l],
                                      .t = a->t[l],
                                      .t_end = a->end[l],
                                      .unit = a->old_unit[l],
                                      .order = b->run->order,
                                      .last = a->end[l] == a->t1[l],
                                      .x = system->x + l,
                                      .y = b->y + l};

        if (a->tried[l])
            QDOT_TRY(system->tried(&step, system->looker));
    }
    return QDOT_OK;
}

static bool
some_lane_is_active(const batch *b)
{
    for (size_t l = 0; l < L; l++)
        if (b->at.active[l])
            return true;
    return false;
}

static qdot_status
run_batch_loop(batch *b)
{
    const qdot_ode_batch *system = b->system;

    for (size_t l = 0; l < L; l++)
        enter_lane(b, l);
    while (some_lane_is_active(b)) {
        QDOT_TRY(qdot_interrupt_check());
        begin_series_in_lanes(b);
        while (judge_lanes(b)) /* repeat, since the equations may be undefined at the start of a solution */
            begin_series_in_lanes(b);
        if (!some_lane_is_active(b))
            break;
        system->extend(b->run->order, system->user);
        b->run->expansions++;
        choose_steps_of_lanes(b);
        shorten_near_hidden_parts(b);
        QDOT_TRY(show_steps_to_caller(b));
        evaluate_ends_in_lanes(b);
    }
    return QDOT_OK;
}

static qdot_status
check_batch_arguments(const qdot_ode_batch *system, const qdot_batch_run *run)
{
    if (system->n == 0)
        return qdot_fail(QDOT_EINVAL, "there is nothing to integrate");
    if (run->order < 2 || run->order > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", run->order);
    QDOT_TRY(qdot_ode_check_tolerance(run->tol));
    for (size_t m = 0; m < run->members; m++) {
        if (!isfinite(run->t0[m]) || !isfinite(run->t1[m]))
            return qdot_fail(QDOT_EINVAL, "the limits of member %zu are not finite", m + 1);
        for (size_t i = 0; i < system->n; i++)
            if (!isfinite(run->y[m * system->n + i]))
                return qdot_fail(QDOT_EINVAL, "initial value %zu of member %zu is not finite",
                                 i + 1, m + 1);
    }
    return QDOT_OK;
}

qdot_status
qdot_ode_batch_run(const qdot_ode_batch *system, qdot_batch_run *run)
{
    batch b = {.system = system,
               .kernels = qdot_batch_kernels_get(),
               .decide = kinds[qdot_batch_kind()],
               .run = run,
               .n = system->n,
               .moving = system->n - system->still,
               .most_steps = run->most_steps ? (int64_t)run->most_steps : max_steps,
               .log_aim = log2(qdot_step_aim(run->tol, false))};
    const double term_tol = run->term_tol != 0 ? run->term_tol : run->tol;
    size_t size = system->n * L;
    double *memory;
    qdot_status status;

    run->expansions = 0;
    QDOT_TRY(check_batch_arguments(system, run));
    memory = qdot_calloc(7 * size + line / sizeof *memory, sizeof *memory);
    if (!memory)
        return QDOT_ENOMEM;
    b.y = (double *)(((uintptr_t)memory + line - 1) / line * line);
    b.carry = b.y + size;
    b.next = b.carry + size;
    b.next_carry = b.next + size;
    b.value = b.next_carry + size;
    b.slope = b.value + size;
    b.first = b.slope + size;
    for (size_t l = 0; l < L; l++)
        b.at.unit[l] = b.at.old_unit[l] = 1;
    for (int k = 1; k <= run->order; k++) {
        b.inverse[k] = 1.0 / k;
        b.upper[k] = qdot_step_fall(b.log_aim, run->order) * (run->order - k);
        b.lower[k] = qdot_step_term(log2(qdot_step_aim(term_tol, false)));
    }
    status = run_batch_loop(&b);
    qdot_free(memory);
    return status;
}
