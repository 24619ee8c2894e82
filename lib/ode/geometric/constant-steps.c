/* constant-steps.c -- integrates by steps of constant length, which is found by a trial run. */
#include "ode/geometric/geometric.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "num/sum.h"
#include "ode/meter.h"
#include "ode/scale.h"
#include "ode/step-decisions.h"
#include "ode/step.h"

enum { trial_steps = 64, most_trial = 4000, window = 32, measured = 16 };

/* The trial run aims at this fraction of the tolerance; the step is the shortest one of the trial times `safe`. */
static const double aim = 0.5, safe = 0.9, most_growth = 5;

/* At a singular place the steps of the trial are so much shorter than others: this part of the longest
 * is then taken, and shortened where that place comes. Behind one the trial goes on while the shortest
 * of a window is so much longer than that of the one before. */
static const double singular = 1e4, of_longest = 0.1, growing = 1.1;

/* Differences of states below this, relative to max(1, |y_i|), count as rounding errors. */
static const double rounding = 8 * DBL_EPSILON;

typedef struct {
    qdot_geometric g;
    const qdot_ode_options *options;
    qdot_ode_result *result;
    double tol, t, t_low, t1, direction;
    double h; /* length of a step, positive */
    double *before, *halves, *full; /* [4n] state with its low part; [2n] each: end of two half steps, of a full step, as (q, q') */
    double work;      /* work already reported to the meter (meter.h) */
    double length; /* length to which the first steps grow after a start near a singularity; 0: they do not */
    const qdot_ode_method *method;
    double *all;   /* the block that holds the arrays */
    struct {
        double h, t_end, t_low; /* its length, positive; its end is t_end + t_low */
    } offered;     /* the step that is offered, whose end is g.y and r->full */
    int undefined;    /* number of attempts in a row from this t at which the forces were undefined */
} run;

qdot_status
qdot_geometric_velocity(qdot_geometric *g, double t, const double *q, const double *p, double *v)
{
    const qdot_ode_phase *phase = g->system->phase;

    if (phase)
        return phase->velocity(t, q, p, v, phase->user);
    memcpy(v, p, g->n * sizeof *v);
    return QDOT_OK;
}

/* Evaluate the forces F at (t, q, v) without checking that they are finite. */
static qdot_status
forces_evaluate(qdot_geometric *g, double t, const double *q, const double *v, double *F)
{
    const qdot_ode_phase *phase = g->system->phase;
    const size_t n = g->n;

    if (phase)
        return phase->force(t, q, v, F, phase->user);
    memcpy(g->state, q, n * sizeof *q);
    memcpy(g->state + n, v, n * sizeof *v);
    QDOT_TRY(g->system->rhs(t, g->state, g->rates, g->system->user));
    memcpy(F, g->rates + n, n * sizeof *F);
    return QDOT_OK;
}

qdot_status
qdot_geometric_force(qdot_geometric *g, double t, const double *q, const double *v, double *F)
{
    g->evaluations++;
    QDOT_TRY(forces_evaluate(g, t, q, v, F));
    return qdot_ode_all_finite(F, g->n)
               ? QDOT_OK
               : qdot_fail(QDOT_EDOMAIN, "the right-hand side is not finite");
}

/* Write the state at t as (q, q') into y [2n]. QDOT_EDOMAIN if it is not finite. */
static qdot_status
write_state(qdot_geometric *g, double t, double *y)
{
    memcpy(y, g->y, g->n * sizeof *y);
    QDOT_TRY(qdot_geometric_velocity(g, t, g->y, g->y + g->n, y + g->n));
    return qdot_ode_all_finite(y, 2 * g->n)
               ? QDOT_OK
               : qdot_fail(QDOT_EDOMAIN, "the state is not finite");
}

/* The state behind a step, into y [2n]. Where the run ends at roots of functions it is looked at, so
 * the force must be defined there: nodes of collocation all lie before the end. */
static qdot_status
write_end_of_step(run *r, double t, double *y)
{
    const size_t n = r->g.n;

    QDOT_TRY(write_state(&r->g, t, y));
    return r->options->at_doubles ? qdot_geometric_force(&r->g, t, y, y + n, r->g.rates + n)
                                  : QDOT_OK;
}

static void
save_state(run *r)
{
    memcpy(r->before, r->g.y, 4 * r->g.n * sizeof *r->before);
}

static void
restore_state(run *r)
{
    memcpy(r->g.y, r->before, 4 * r->g.n * sizeof *r->before);
    r->g.known = false;
}

static qdot_status
make_kernel_step(run *r, double t, double h)
{
    const qdot_status status = r->g.kernel->step(&r->g, t, h);

    r->g.h = h;
    return status;
}

/* Measure a step of signed length h from the state, and take it: its end is in r->full. On a failure
 * the state is that of before. */
static qdot_status
measure_step(run *r, double h, double *ratio)
{
    qdot_status status;

    save_state(r);
    r->g.known = false;
    status = make_kernel_step(r, r->t, 0.5 * h);
    if (status == QDOT_OK)
        status = make_kernel_step(r, r->t + 0.5 * h, 0.5 * h);
    if (status == QDOT_OK)
        status = write_state(&r->g, r->t + h, r->halves);
    restore_state(r);
    if (status == QDOT_OK)
        status = make_kernel_step(r, r->t, h);
    if (status == QDOT_OK)
        status = write_end_of_step(r, r->t + h, r->full);
    if (status != QDOT_OK) {
        restore_state(r);
        return status;
    }
    *ratio = 0;
    for (size_t i = 0; i < 2 * r->g.n; i++) {
        const double size = qdot_ode_size(r->g.system->scales, i, r->full[i]);
        const double apart = fabs(r->full[i] - r->halves[i]) - rounding * size;

        *ratio = fmax(*ratio, apart / (r->tol * size));
    }
    return QDOT_OK;
}

/* The factor by which the step length is changed for an error ratio (error divided by tolerance). */
static double
growth_factor(const run *r, double ratio)
{
    const double f = ratio > 0 ? safe * pow(ratio / aim, -1.0 / (r->g.kernel->order + 1)) : most_growth;

    return fmin(most_growth, fmax(0.1, f));
}

/* Choose a step length to try first: one that changes the state by a hundredth, or the whole
 * distance if shorter. */
static qdot_status
choose_first_length(run *r, double distance)
{
    const size_t n = r->g.n;
    double size = 0, rate = 0;

    QDOT_TRY(write_state(&r->g, r->t, r->full));
    QDOT_TRY(qdot_geometric_force(&r->g, r->t, r->g.y, r->full + n, r->halves));
    for (size_t i = 0; i < 2 * n; i++) {
        size = fmax(size, fabs(r->full[i]));
        rate = fmax(rate, fabs(i < n ? r->full[n + i] : r->halves[i - n]));
    }
    r->h = fmin(distance, 0.01 * fmax(1e-3, size) / fmax(rate, DBL_MIN));
    return QDOT_OK;
}

static qdot_status
fail_with_small_step(const run *r)
{
    return qdot_fail(QDOT_EFAILED,
                     "stopped at t = %.17g: no step down to %.2g keeps the error below %.2g", r->t,
                     r->h, r->tol);
}

static double
least_step_length(const run *r)
{
    return 16 * DBL_EPSILON * fmax(fabs(r->t), DBL_MIN / DBL_EPSILON);
}

/* End the run at time r->t, with the last error as the reason. */
static qdot_status
end_run_with_failure(const run *r)
{
    const qdot_error why = *qdot_last_error();

    qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t, why.message);
    return why.hint[0] ? qdot_hint("%s", why.hint) : QDOT_EFAILED;
}

/* The lengths of the steps made by the trial run. */
typedef struct {
    double first, shortest, longest;
    double now, before; /* shortest accepted step in the present window of the trial; in the previous window */
    bool grows;
} lengths;

static void
record_length(lengths *l, double h)
{
    if (l->longest == 0)
        l->first = h;
    l->shortest = fmin(l->shortest, h);
    l->longest = fmax(l->longest, h);
    l->now = fmin(l->now, h);
}

/* Whether step k of the trial run is still to be made. */
static bool
trial_goes_on(lengths *l, int k)
{
    if (k > 0 && k % window == 0) {
        l->grows = l->grows && (k == window || l->now > growing * l->before);
        l->before = l->now;
        l->now = INFINITY;
    }
    return k < (l->grows ? most_trial : trial_steps);
}

/* Make steps of variable length from the start for the trial, and record their lengths. */
static qdot_status
make_trial_steps(run *r, lengths *l)
{
    const double distance = fabs(r->t1 - r->t), t0 = r->t;

    for (int k = 0; fabs(r->t - t0) < distance * (1 - qdot_step_sliver) && trial_goes_on(l, k); k++) {
        const double whole = r->h, h = fmin(whole, distance - fabs(r->t - t0));
        double ratio;
        const qdot_status status = measure_step(r, r->direction * h, &ratio);

        if (qdot_ode_may_be_undefined(status) && h > least_step_length(r)) {
            r->h = qdot_step_quarter * h;
            continue;
        }
        QDOT_TRY(status);
        r->h = h * growth_factor(r, ratio);
        if (ratio > 1) {
            restore_state(r);
            if (!(r->h > least_step_length(r)))
                return fail_with_small_step(r);
            continue;
        }
        r->t += r->direction * h;
        if (r->h < most_growth * h) /* the step did not grow by the largest factor: the tolerance limited it */
            record_length(l, r->h);
        else if (h < whole) /* the step was shortened to end at t1 */
            r->h = fmax(r->h, whole);
    }
    return QDOT_OK;
}

/* Choose the constant step length of the run from the lengths of the trial. */
static void
choose_constant_length(run *r, const lengths *l)
{
    const double length = safe * of_longest * l->longest;

    if (!isfinite(l->shortest))
        return;
    r->h = safe * l->shortest;
    if (!(l->longest > singular * l->shortest))
        return;
    r->h = fmin(safe * l->first, length);
    r->length = r->h < length ? length : 0;
}

/* Find the step length by a trial run, after which the state is reset to the start. */
static qdot_status
find_step_length(run *r)
{
    const double t0 = r->t;
    double *start = qdot_malloc(4 * r->g.n * sizeof *start);
    lengths l = {.shortest = INFINITY, .now = INFINITY, .grows = true};
    qdot_status status = start ? choose_first_length(r, fabs(r->t1 - r->t)) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(start, r->g.y, 4 * r->g.n * sizeof *start);
        status = make_trial_steps(r, &l);
    }
    /* if the trial stops where f is undefined, so will the run, at the same time */
    if (qdot_ode_may_be_undefined(status))
        status = r->h > 0 ? QDOT_OK : end_run_with_failure(r);
    if (start && status == QDOT_OK) {
        memcpy(r->g.y, start, 4 * r->g.n * sizeof *start);
        r->g.known = false;
        r->t = t0;
        choose_constant_length(r, &l);
    }
    qdot_free(start);
    return status;
}

/* Handle a step inside which f is undefined somewhere: try a shorter one, or fail. */
static qdot_status
handle_undefined_step(run *r, double h, qdot_status status)
{
    if (!qdot_ode_may_be_undefined(status))
        return status;
    r->result->stats.rejected++;
    r->h = qdot_step_quarter * h;
    if (++r->undefined <= QDOT_STEP_ATTEMPTS && r->h > least_step_length(r) && !(r->options->h_fixed > 0))
        return QDOT_OK;
    return end_run_with_failure(r);
}

/* Make a step of signed length h without an error estimate. */
static qdot_status
make_plain_step(run *r, double h)
{
    qdot_status status;

    save_state(r);
    status = make_kernel_step(r, r->t, h);
    if (status == QDOT_OK)
        status = write_end_of_step(r, r->t + h, r->full);
    if (status != QDOT_OK)
        restore_state(r);
    return status;
}

/* After a step that was shortened near a singularity: let steps grow back to the constant length. */
static void
let_step_grow(run *r, double h, double ratio)
{
    r->h = fmin(r->length, h * growth_factor(r, ratio));
    if (r->h == r->length)
        r->length = 0;
}

/* The end of the step just made, of h, which may be the last. */
static void
set_end_of_step(run *r, double h, bool last)
{
    r->offered.h = h;
    r->offered.t_end = r->t;
    r->offered.t_low = r->t_low;
    if (last) {
        r->offered.t_end = r->t1;
        r->offered.t_low = 0;
    } else {
        qdot_sum_advance(&r->offered.t_end, &r->offered.t_low, r->direction * h);
    }
}

/* Try to make a step; *made: it can be offered. */
static qdot_status
try_next_step(run *r, bool *made)
{
    const double rest = r->direction * ((r->t1 - r->t) - r->t_low);
    const bool last = r->h >= rest * (1 - qdot_step_sliver);
    const double h = last ? rest : r->h;
    const bool look = (r->length > 0 || r->result->stats.steps % measured == 0)
                      && !(r->options->h_fixed > 0);
    double ratio = 0;
    qdot_status status;

    *made = false;
    QDOT_TRY(qdot_interrupt_check());
    if (r->result->stats.steps + r->result->stats.rejected >= qdot_ode_most_steps(r->options))
        return qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g after %llu steps", r->t,
                         (unsigned long long)qdot_ode_most_steps(r->options));
    status = look ? measure_step(r, r->direction * h, &ratio) : make_plain_step(r, r->direction * h);
    if (status != QDOT_OK)
        return handle_undefined_step(r, h, status);
    *made = ratio <= 1;
    if (*made) {
        if (r->length > 0 && !last)
            let_step_grow(r, h, ratio);
        set_end_of_step(r, h, last);
        return QDOT_OK;
    }
    restore_state(r);
    r->result->stats.rejected++;
    r->h = h * fmin(safe, growth_factor(r, ratio));
    return r->h > least_step_length(r) ? QDOT_OK : fail_with_small_step(r);
}

static qdot_status
report_work(run *r)
{
    const qdot_ode_stats stats = {.evaluations = r->g.evaluations};
    const double now = qdot_ode_work(r->g.system, &stats), more = now - r->work;

    r->work = now;
    return qdot_ode_meter_add(r->options->meter, r->t, more);
}

/* Fail if the run would take more steps of this length than allowed. */
static qdot_status
check_number_of_steps(const run *r)
{
    const double steps = fabs(r->t1 - r->t) / fmax(r->h, r->length);

    if (steps < (double)qdot_ode_most_steps(r->options))
        return QDOT_OK;
    qdot_fail(QDOT_ELIMIT,
              "stopped at t = %.17g: tol %.2g takes steps of %.2g, %.2g of them: more than %.2g", r->t,
              r->tol, r->h, steps, (double)qdot_ode_most_steps(r->options));
    return qdot_hint("a larger tol, or a method of higher order");
}

static qdot_status
look_behind_attempt(run *r)
{
    if (r->options->meter)
        QDOT_TRY(report_work(r));
    qdot_progress_at(r->t);
    return QDOT_OK;
}

/* The constant length, given or by a trial. */
static qdot_status
choose_length(run *r)
{
    const double distance = fabs(r->t1 - r->t);

    if (distance == 0)
        return QDOT_OK;
    if (r->options->h_fixed > 0)
        r->h = distance / ceil(distance / r->options->h_fixed * (1 - qdot_step_sliver));
    else
        QDOT_TRY(find_step_length(r));
    return check_number_of_steps(r);
}

/* --- the controller ------------------------------------------------------------------ */

static qdot_status
check_arguments(const run *r, double t0, const double *y)
{
    if (!r->g.system->halves && (!r->g.system->phase || r->g.kernel->separable))
        return qdot_fail(QDOT_EINVAL, "this method is for q' = v, v' = F alone");
    if (r->g.system->bonds && !r->g.kernel->of_bonds)
        return qdot_fail(QDOT_EINVAL, "this method is for systems without constraints");
    QDOT_TRY(qdot_ode_check_tolerance(r->tol));
    return qdot_ode_check_limits(r->g.system, t0, r->t1, y);
}

/* Allocate all arrays in one block. */
static qdot_status
constant_steps_allocate(run *r)
{
    const size_t n = r->g.n;
    const size_t m = r->g.system->bonds ? r->g.system->bonds->m : 0;
    const size_t own = r->g.kernel->rows * n + r->g.kernel->more + r->g.kernel->of_bonds * m;
    double *x = qdot_calloc(16 * n + own + 1, sizeof *x);

    r->all = x;
    if (!x)
        return QDOT_ENOMEM;
    r->g.y = x;
    r->g.low = x + 2 * n;
    r->before = x + 4 * n;
    r->halves = x + 8 * n;
    r->full = x + 10 * n;
    r->g.state = x + 12 * n;
    r->g.rates = x + 14 * n;
    r->g.work = x + 16 * n;
    return QDOT_OK;
}

/* Begin at the state y, with velocities converted to momenta if the system has canonical ones. */
static qdot_status
begin_at_state(run *r, const double *y)
{
    const qdot_ode_phase *phase = r->g.system->phase;
    const size_t n = r->g.n;

    if (!phase)
        return QDOT_OK;
    memset(r->g.low + n, 0, n * sizeof *r->g.low);
    return phase->momenta(r->t, y, y + n, r->g.y + n, phase->user);
}

static qdot_status
constant_open(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options,
              double t0, double t1, const double *y, qdot_ode_result *result, void **out)
{
    run *r = qdot_malloc(sizeof *r);

    *out = r;
    if (!r)
        return QDOT_ENOMEM;
    *r = (run){.g = {.system = system, .kernel = method->geometric, .n = system->n / 2},
               .method = method,
               .options = options,
               .result = result,
               .tol = qdot_ode_tolerance(options),
               .t = t0,
               .t1 = t1,
               .direction = t1 < t0 ? -1 : 1};
    QDOT_TRY(check_arguments(r, t0, y));
    QDOT_TRY(constant_steps_allocate(r));
    memcpy(r->g.y, y, system->n * sizeof *y);
    if (options->carry)
        memcpy(r->g.low, options->carry, system->n * sizeof *y);
    if (r->g.kernel->begin)
        r->g.kernel->begin(&r->g);
    QDOT_TRY(begin_at_state(r, y));
    return choose_length(r);
}

static qdot_status
constant_offer(void *run_, qdot_ode_step *step)
{
    run *r = run_;
    bool made;

    for (;;) {
        QDOT_TRY(try_next_step(r, &made));
        if (made)
            break;
        QDOT_TRY(look_behind_attempt(r));
    }
    *step = (qdot_ode_step){.method = r->method, .t_end = r->offered.t_end, .y_end = r->full};
    return QDOT_OK;
}

static qdot_status
constant_accept(void *run_)
{
    run *r = run_;

    r->t = r->offered.t_end;
    r->t_low = r->offered.t_low;
    r->undefined = 0;
    r->result->stats.steps++;
    return look_behind_attempt(r);
}

static qdot_status
constant_refuse(void *run_, qdot_status why)
{
    run *r = run_;

    restore_state(r);
    if (why != QDOT_EDOMAIN)
        return why;
    QDOT_TRY(handle_undefined_step(r, r->offered.h, why));
    return look_behind_attempt(r);
}

/* The state as (q, q'), which is in doubles. */
static void
constant_state(void *run_, double *y, double *low)
{
    run *r = run_;
    const qdot_error why = *qdot_last_error();

    if (write_state(&r->g, r->t, y) != QDOT_OK)
        qdot_fail_again(&why);
    if (low)
        memset(low, 0, 2 * r->g.n * sizeof *low);
}

static void
constant_close(void *run_)
{
    run *r = run_;

    r->result->stats.evaluations = r->g.evaluations;
    qdot_free(r->all);
    qdot_free(r);
}

const qdot_ode_control qdot_ode_constant_steps = {.open = constant_open,
                                                  .offer = constant_offer,
                                                  .accept = constant_accept,
                                                  .refuse = constant_refuse,
                                                  .state = constant_state,
                                                  .close = constant_close};
