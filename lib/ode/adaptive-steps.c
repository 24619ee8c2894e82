/* adaptive-steps.c -- steps under a bound for the error of each: tries one, judges it, chooses the next length. */
#include "ode/step.h"

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
#include "ode/stiffness.h"
#include "ode/stepper.h"

/* The error that a step aims at, as a fraction of its bound: few steps are then rejected, and for
 * an order of 8 the whole run costs a quarter more and errs eight times less. */
static const double aim = 0.1;

/* If a new step length is costly, the step grows by at least this factor or not at all. */
static const double worthwhile = 1.2;

/* The most that a step changes by, and that of a method that damps what is stiff: behind what dies out
 * its steps have far to grow. */
static const double most_change = 5, most_change_stiff = 25;

/* Steps shorter than this many smallest steps are limited by the resolution of t, not by stability. */
static const double coarse = 64;

typedef struct {
    qdot_ode_stepper *s;
    const qdot_ode_options *options;
    qdot_ode_result *result;
    double t, t_carry; /* the present time is t + t_carry */
    double t1;
    double until; /* the end of the present step at the latest: t1, or a time before at which f is not smooth */
    double direction; /* direction of time: +1 or -1 */
    double h;         /* length of the next step to try, positive */
    uint64_t max_steps;
    int undefined;      /* number of attempts in a row from this t in which f was undefined */
    bool just_rejected; /* the last try was rejected: the next step must not grow */
    qdot_error last_undefined; /* the last error of the right-hand side f */
    double undefined_at;       /* end of the step at which f was undefined; NaN: none yet */
    double margin, margin_at; /* value of system->margin when it was asked for last, and the time t of that */
    double best;               /* largest value of system->margin so far */
    double longest;            /* length of the longest step taken so far */
    double work;               /* work already reported to the meter (meter.h) */
    qdot_ode_stiffness stiffness;
    uint64_t looked;           /* evaluations of f used to detect forces that a step would miss */
    int crawled;               /* number of steps in a row that were tiny compared with the rest of the run */
    struct {
        double h, ratio;       /* its length, positive, and the ratio of its error to the bound */
        double end, end_carry; /* the time of its end is end + end_carry */
    } offered;                 /* the step that is offered */
} run;

/* A run towards a singular place stops after so many consecutive steps below this fraction of the
 * way to it and of the longest step, if rounding over the square of the remaining margin is above
 * the tolerance: rounding then makes their error, and the place is never reached. */
static const double crawl = 0x1p-8, shrunk = 0x1p-4;
enum { most_crawled = 4, seldom = 32 };

/* The distance from |t| to the next larger double. */
static double
spacing(double t)
{
    t = fabs(t);
    return nextafter(t, INFINITY) - t;
}

static double
least_step_length(const run *r)
{
    return fmax(16 * spacing(r->t), 16 * DBL_MIN);
}

/* The scaled norm max_i |x_i| / (tol max(s_i, |y_i|)) of x [n]: a derivative of the state y, or a difference of two. */
static double
scaled_norm(const run *r, const double *x, const double *y)
{
    double largest = 0;

    for (size_t i = 0; i < r->s->system->n; i++)
        largest = fmax(largest, fabs(x[i])
                                    / (r->s->tol * qdot_ode_size(r->s->system->scales, i, y[i])));
    return largest;
}

/* Hairer's starting step: from the size of y, a scale at least, and of y', then of y'' by an Euler
 * step. */
static qdot_status
choose_first_step(run *r, double distance)
{
    qdot_ode_stepper *s = r->s;
    const size_t n = s->system->n;
    double p = s->method->multistep ? 1 : qdot_ode_stepper_error_power(s);
    const double d0 = 1 / s->tol;
    double d1, d2, h0;

    QDOT_TRY(qdot_ode_stepper_rhs(s, r->t, s->y, s->dydt));
    s->dydt_known = true;
    d1 = scaled_norm(r, s->dydt, s->y);
    h0 = d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
    h0 = fmin(h0, distance);
    r->h = h0;
    for (size_t i = 0; i < n; i++)
        s->trial[i] = s->y[i] + r->direction * h0 * s->dydt[i];
    if (qdot_ode_stepper_rhs(s, r->t + r->direction * h0, s->trial, s->trial_dydt) !=
        QDOT_OK) {
        /* begin with the step h0 although f is undefined at its end: the steps will show how far f is defined */
        return QDOT_OK;
    }
    for (size_t i = 0; i < n; i++)
        s->trial_dydt[i] -= s->dydt[i];
    d2 = scaled_norm(r, s->trial_dydt, s->y) / h0;
    if (fmax(d1, d2) <= 1e-15)
        r->h = fmax(1e-6, h0 * 1e-3);
    else
        r->h = pow(0.01 / fmax(d1, d2), 1 / (p + 1));
    r->h = fmin(fmin(100 * h0, r->h), distance);
    if (r->options->first_share > 0)
        r->h *= r->options->first_share;
    /* the step is below the spacing of doubles at t, as for a system at rest at large t */
    if (r->h < 2 * least_step_length(r))
        r->h = fmin(2 * least_step_length(r), distance);
    return QDOT_OK;
}

/* The time left until r->until, the exact end t1 + t1_low or a time at which f is not smooth, computed without rounding
 * near the end. */
static double
remaining_time(const run *r)
{
    return r->direction * ((r->until - r->t) - r->t_carry + (r->until == r->t1 ? r->options->t1_low : 0));
}

/* A step of about h that ends on a double of t, where a little more or less costs nothing: what is
 * stored there belongs to that t, and not to one half a double beside it. */
static double
round_step_end(const run *r, double h)
{
    const qdot_ode_method *method = r->s->method;

    if (!r->options->at_doubles || method->multistep
        || (method->kernel && method->kernel->keeps_step) || r->options->h_fixed > 0)
        return h;
    return fabs((r->t + (r->t_carry + r->direction * h)) - r->t);
}

/* The step to try now. If the rest after it would be too short for a step, the step includes it
 * or is shortened so that both are equal. A rest that has no two steps is one. */
static double
choose_step(const run *r, bool *last)
{
    double rest = remaining_time(r);

    *last = r->h >= rest * (1 - qdot_step_sliver) || (rest < 2 * least_step_length(r) && !(r->options->h_fixed > 0));
    if (*last)
        return rest;
    if (!r->s->method->multistep && !(r->options->h_fixed > 0) && r->h > 0.5 * rest)
        return round_step_end(r, 0.5 * rest);
    return round_step_end(r, r->h);
}

static void
control_step_length(run *r, double h, double ratio, bool accepted)
{
    const bool stiff = r->s->method->kernel && r->s->method->stiff;
    const double most = stiff ? most_change_stiff : most_change;
    double power = qdot_ode_stepper_error_power(r->s), factor;

    if (r->options->h_fixed > 0)
        return;
    factor = ratio > 0 ? 0.9 * pow(ratio / aim, -1 / power) : most;
    factor = fmin(most, fmax(1 / most, factor));
    if (accepted && (r->just_rejected || (r->s->method->multistep && factor < 1.5)))
        factor = fmin(1, factor);
    if (accepted && r->s->method->multistep)
        factor = fmax(1, factor);
    if (accepted && r->s->method->kernel && r->s->method->kernel->keeps_step && factor >= 1
        && factor < worthwhile)
        factor = 1;
    /* a step that was shortened to end at t1 does not reduce the next one; none that ends where f is not smooth does */
    if (accepted && r->t + r->direction * h == r->until && r->until != r->t1)
        r->h = fmax(h * factor, r->h);
    else
        r->h = accepted ? fmax(h * factor, h < r->h * (1 - 1e-9) ? fmin(r->h, 5 * h) : 0) : h * factor;
}

/* Handle a step inside which f is undefined somewhere: try a shorter one, or fail. */
static qdot_status
handle_undefined_step(run *r, double h, qdot_status status)
{
    if (!qdot_ode_may_be_undefined(status))
        return status;
    r->last_undefined = *qdot_last_error();
    r->undefined_at = r->t + r->direction * h;
    r->result->stats.rejected++;
    r->just_rejected = true;
    r->h = qdot_step_quarter * h;
    if (++r->undefined > QDOT_STEP_ATTEMPTS || r->h < least_step_length(r) ||
        r->options->h_fixed > 0) {
        qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t,
                  r->last_undefined.message);
        return r->last_undefined.hint[0] ? qdot_hint("%s", r->last_undefined.hint)
                                         : QDOT_EFAILED;
    }
    return QDOT_OK;
}

static qdot_status
fail_with_too_small_step(run *r)
{
    /* the cause is a point not yet passed at which f is undefined */
    if (r->direction * (r->undefined_at - r->t) >= 0)
        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t,
                         r->last_undefined.message);
    if (r->crawled >= most_crawled)
        return qdot_fail(QDOT_EFAILED,
                         "stopped at t = %.17g: steps came down to %.2g, their error being of "
                         "rounding", r->t, r->h);
    qdot_fail(QDOT_EFAILED,
              "stopped at t = %.17g: no step down to %.2g keeps the error below %.2g",
              r->t, least_step_length(r), r->s->tol);
    return qdot_hint("the solution has a singularity there, or the tolerance is below "
                     "what double precision can hold");
}

/* Called after a rejected step, and now and then. The place ahead is where the margin,
 * extrapolated linearly, would be 0. */
static bool
approaches_singularity(run *r)
{
    const qdot_ode_system *system = r->s->system;
    double now, ahead;

    if (!system->margin || r->t == r->margin_at)
        return false;
    now = system->margin(r->t, r->s->y, system->user);
    ahead = now * fabs(r->t - r->margin_at) / (r->margin - now);
    r->best = fmax(r->best, now);
    r->crawled = r->margin > now && r->h < crawl * ahead && r->h < shrunk * r->longest
                         && r->s->tol * now * now < DBL_EPSILON * r->best * r->best
                     ? r->crawled + 1
                     : 0;
    r->margin = now;
    r->margin_at = r->t;
    return r->crawled >= most_crawled;
}

/* Find whether the step passes over a force that acts only for a shorter time; if so, shorten it. */
static qdot_status
look_for_missed_forces(run *r, double h, double end, bool *clear)
{
    const qdot_ode_system *system = r->s->system;
    qdot_ode_look step = {.t = r->t,
                          .t_end = end,
                          .tol = r->s->tol,
                          .y = r->s->y,
                          .y_end = r->s->trial,
                          .until = end};

    *clear = true;
    if (!system->look || r->options->h_fixed > 0)
        return QDOT_OK;
    QDOT_TRY(system->look(&step, system->user));
    r->looked += step.evaluations;
    if (step.until == end || fmin(fabs(step.until - r->t), 0.5 * h) < least_step_length(r))
        return QDOT_OK;
    *clear = false;
    r->result->stats.rejected++;
    r->just_rejected = true;
    r->h = fmin(fabs(step.until - r->t), 0.5 * h);
    return QDOT_OK;
}

/* The end of a step of h, whose double is `end` but for the last. */
static void
set_end_of_step(run *r, double h, bool last)
{
    r->offered.end = r->t;
    r->offered.end_carry = r->t_carry;
    if (last) {
        r->offered.end = r->until;
        r->offered.end_carry = 0;
    } else {
        qdot_sum_advance(&r->offered.end, &r->offered.end_carry, r->direction * h);
    }
}

/* Try one step; *good: it can be offered. */
static qdot_status
try_step(run *r, bool *good)
{
    bool last;
    const double h = choose_step(r, &last);
    double ratio, end;
    qdot_status status;

    *good = false;
    QDOT_TRY(qdot_interrupt_check());
    if (r->result->stats.steps + r->result->stats.rejected >= r->max_steps)
        return qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g after %llu steps", r->t,
                         (unsigned long long)r->max_steps);
    if (r->options->max_evaluations &&
        r->s->evaluations + r->looked >= r->options->max_evaluations)
        return qdot_fail(QDOT_ELIMIT, "stopped at t = %.6g after %llu evaluations", r->t,
                         (unsigned long long)r->options->max_evaluations);
    if (!last && h < least_step_length(r))
        return fail_with_too_small_step(r);
    status = qdot_ode_stepper_try(r->s, r->t, r->direction * h, &ratio);
    if (status != QDOT_OK)
        return handle_undefined_step(r, h, status);
    end = last ? r->until : r->t + (r->t_carry + r->direction * h);
    if (ratio <= 1)
        status = qdot_ode_stepper_project(r->s, end, &ratio);
    if (status != QDOT_OK)
        return handle_undefined_step(r, h, status);
    if (r->options->h_fixed > 0 && ratio < INFINITY)
        ratio = fmin(ratio, 1);
    if (ratio <= 1) {
        r->offered.h = h;
        r->offered.ratio = ratio;
        set_end_of_step(r, h, last);
        return look_for_missed_forces(r, h, end, good);
    }
    r->result->stats.rejected++;
    r->just_rejected = true;
    control_step_length(r, h, ratio, false);
    if (r->options->h_fixed > 0)
        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: the step overflows", r->t);
    return r->h < least_step_length(r) || approaches_singularity(r) ? fail_with_too_small_step(r) : QDOT_OK;
}

/* Report to the meter (meter.h) the work done since the last report. */
static qdot_status
report_work_of_run(run *r)
{
    const qdot_ode_stats stats = {.evaluations = r->s->evaluations + r->looked,
                                  .jacobians = r->s->jacobians,
                                  .factorisations = r->s->factorisations};
    const double now = qdot_ode_work(r->s->system, &stats), more = now - r->work;

    r->work = now;
    return qdot_ode_meter_add(r->options->meter, r->t, more);
}

static qdot_status
look_for_stiffness(run *r)
{
    const qdot_ode_stats stats = {.evaluations = r->s->evaluations + r->looked};
    const uint64_t steps = r->result->stats.steps;
    const double work = qdot_ode_work(r->s->system, &stats) / (double)(steps ? steps : 1);
    const qdot_ode_stiff_step at = {.system = r->s->system,
                                    .n = r->s->system->n,
                                    .t = r->t,
                                    .t1 = r->t1,
                                    .y = r->s->y,
                                    .scales = r->s->system->scales,
                                    .noise = r->s->tol,
                                    .work = work,
                                    .most = r->max_steps,
                                    .implicit = r->s->method->stiff};

    return qdot_ode_stiffness_look(&r->stiffness, &at, r->options, &r->result->stiff);
}

/* Behind each attempt: count its work; now and then see whether the run gets anywhere. */
static qdot_status
look_behind_attempt(run *r)
{
    if (r->options->meter)
        QDOT_TRY(report_work_of_run(r));
    if (qdot_ode_stiffness_is_due(&r->stiffness) && r->h > coarse * least_step_length(r))
        QDOT_TRY(look_for_stiffness(r));
    qdot_progress_at(r->t);
    return QDOT_OK;
}

static qdot_status
choose_first_length(run *r)
{
    const double distance = fabs(r->t1 - r->t);
    qdot_status status;

    if (r->options->h_fixed > 0) {
        r->h = distance / ceil(distance / r->options->h_fixed * (1 - qdot_step_sliver));
        return QDOT_OK;
    }
    if (r->options->h_first > 0) {
        r->h = fmin(r->options->h_first, distance);
        return QDOT_OK;
    }
    status = choose_first_step(r, distance);
    if (!qdot_ode_may_be_undefined(status))
        return status;
    r->last_undefined = *qdot_last_error();
    return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t, r->last_undefined.message);
}

/* --- the controller ------------------------------------------------------------------ */

static qdot_status
adaptive_open(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options,
              double t0, double t1, const double *y, qdot_ode_result *result, void **out)
{
    run *r;

    QDOT_TRY(qdot_ode_check_limits(system, t0, t1, y));
    QDOT_TRY(qdot_ode_enter(system, options, t0, y));
    *out = r = qdot_malloc(sizeof *r);
    if (!r)
        return QDOT_ENOMEM;
    *r = (run){.options = options,
               .result = result,
               .t = t0,
               .t1 = t1,
               .direction = t1 < t0 ? -1 : 1,
               .max_steps = qdot_ode_most_steps(options),
               .undefined_at = NAN,
               .margin_at = NAN};
    if (t0 == t1 && system->n > 0)
        return QDOT_OK;
    QDOT_TRY(qdot_ode_stepper_new(system, method, qdot_ode_tolerance(options), &r->s));
    qdot_ode_stepper_start(r->s, y);
    return choose_first_length(r);
}

static qdot_status
adaptive_offer(void *run_, qdot_ode_step *step)
{
    run *r = run_;
    bool good;

    for (;;) {
        r->until = r->options->h_fixed > 0 ? r->t1 : qdot_ode_until(r->s->system, r->t, r->t1);
        QDOT_TRY(try_step(r, &good));
        if (good)
            break;
        QDOT_TRY(look_behind_attempt(r));
    }
    *step = (qdot_ode_step){.method = r->s->method, .t_end = r->offered.end, .y_end = r->s->trial};
    return QDOT_OK;
}

static qdot_status
adaptive_accept(void *run_)
{
    run *r = run_;

    r->longest = fmax(r->longest, r->offered.h);
    control_step_length(r, r->offered.h, r->offered.ratio, true);
    r->result->stats.projections += r->s->projected;
    qdot_ode_stepper_accept(r->s);
    r->t = r->offered.end;
    r->t_carry = r->offered.end_carry;
    r->undefined = 0;
    r->just_rejected = false;
    r->result->stats.steps++;
    if (r->result->stats.steps % seldom == 0 && approaches_singularity(r))
        return fail_with_too_small_step(r);
    return look_behind_attempt(r);
}

static qdot_status
adaptive_refuse(void *run_, qdot_status why)
{
    run *r = run_;

    if (why != QDOT_EDOMAIN)
        return why;
    QDOT_TRY(handle_undefined_step(r, r->offered.h, why));
    return look_behind_attempt(r);
}

static void
adaptive_state(void *run_, double *y, double *low)
{
    const qdot_ode_stepper *s = ((const run *)run_)->s;

    if (s)
        memcpy(y, s->y, s->system->n * sizeof *y);
    if (s && low)
        memcpy(low, s->carry, s->system->n * sizeof *low);
}

static void
adaptive_close(void *run_)
{
    run *r = run_;
    const qdot_ode_stepper *s = r->s;
    qdot_ode_stats *stats = &r->result->stats;

    if (s) {
        stats->evaluations = s->evaluations + r->looked;
        stats->jacobians = s->jacobians;
        stats->factorisations = s->factorisations;
        stats->raised = s->raised > s->tol ? s->raised : 0;
    }
    qdot_ode_stepper_free(r->s);
    qdot_ode_stiffness_clear(&r->stiffness);
    qdot_free(r);
}

const qdot_ode_control qdot_ode_adaptive_steps = {.open = adaptive_open,
                                                  .offer = adaptive_offer,
                                                  .accept = adaptive_accept,
                                                  .refuse = adaptive_refuse,
                                                  .state = adaptive_state,
                                                  .close = adaptive_close};
