/* taylor.c -- the controller of steps by Taylor series: attempts at a step, what is looked at behind each. */
#include "ode/taylor.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "ode/meter.h"
#include "ode/scale.h"
#include "ode/step.h"
#include "ode/step-decisions.h"
#include "ode/taylor-run.h"

enum { ARRAYS = 10 };

typedef qdot_ode_taylor_run run;

/* After this many rejected steps the lowest orders of the series are no longer computed in two doubles. */
enum { taken_back = 100 };

/* --- attempts at a step -------------------------------------------------------------- */

static qdot_status
taylor_too_small(const run *r)
{
    if (r->direction * (r->undefined_at - r->t) >= 0)
        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t,
                         r->undefined.message);
    qdot_fail(QDOT_EFAILED,
              "stopped at t = %.17g: no step down to %.2g keeps the error below %.2g",
              r->t, qdot_step_floor(r->t), r->tol);
    return qdot_hint("the solution has a singularity there, or the tolerance is below "
                     "what double precision can hold");
}

/* The attempt at a step failed with that status, or QDOT_OK if its end does not confirm it: prepare another one. */
static qdot_status
prepare_another_attempt(run *r, qdot_status status)
{
    const double h = r->attempt.h;

    if (status != QDOT_OK && !qdot_ode_may_be_undefined(status))
        return status;
    r->result->stats.rejected++;
    if (status != QDOT_OK) {
        r->undefined = *qdot_last_error();
        r->undefined_at = r->t + r->direction * h;
    }
    if (status != QDOT_OK || !qdot_ode_taylor_run_meets_noise(r)) {
        r->attempt.before = status == QDOT_OK ? r->defect : 0;
        r->attempt.most = qdot_step_quarter * h;
        if (r->attempt.tries == QDOT_STEP_ATTEMPTS || r->attempt.most < qdot_step_floor(r->t)
            || r->options->h_fixed > 0)
            return taylor_too_small(r);
    }
    r->attempt.tries++;
    return QDOT_OK;
}

/* Decide whether to generate machine code from the length of the first step, before that is taken. */
static qdot_status
decide_code_by_first_step(run *r, double most, double *h)
{
    bool again;

    QDOT_TRY(qdot_ode_written_first(&r->written, fabs(r->t1 - r->t) / *h - 1, &again));
    if (!again)
        return QDOT_OK;
    r->result->stats.evaluations = r->counted = 0;
    qdot_ode_taylor_run_set_unit(r, r->first_unit);
    QDOT_TRY(qdot_ode_taylor_run_begin(r, r->t, r->y));
    return qdot_ode_taylor_run_length(r, most, h);
}

/* Find by the series at the present state how long a step may be. */
static qdot_status
find_length(run *r, double *h)
{
    if (r->attempt.tries > 0) { /* compute the series again, as it now belongs to another point */
        qdot_ode_taylor_run_set_unit(r, r->direction * qdot_step_unit(r->attempt.most));
        QDOT_TRY(qdot_ode_taylor_run_begin(r, r->t, r->y));
    }
    QDOT_TRY(qdot_ode_taylor_run_length(r, r->attempt.most, h));
    return r->written.first ? decide_code_by_first_step(r, r->attempt.most, h) : QDOT_OK;
}

/* Report to the meter (meter.h) the work done since the last report. */
static qdot_status
report_work(run *r)
{
    /* the number of expansions; a rejected step counts one more, as its series is begun a second time */
    const uint64_t now = r->result->stats.evaluations + r->result->stats.rejected;
    const double work = (double)(now - r->counted) * r->work;

    r->counted = now;
    return qdot_ode_meter_add(r->options->meter, r->t, work);
}

static qdot_status
look_for_stiffness(run *r)
{
    const qdot_ode_stiff_step at = {.system = r->system,
                                    .n = r->n,
                                    .t = r->t,
                                    .t1 = r->t1,
                                    .y = r->y,
                                    .scales = r->least,
                                    .noise = 4 * exp2(r->log_wanted) + 8 * DBL_EPSILON,
                                    .work = r->work,
                                    .most = r->max_steps,
                                    .high = true};

    return qdot_ode_stiffness_look(&r->stiffness, &at, r->options, &r->result->stiff);
}

/* Under a stiff force the rounding of low orders is that of another start, which the others carry on and
 * which dies out; low orders in two doubles do not fit to these, and nearly all steps are taken back. */
static qdot_status
end_if_two_doubles_do_harm(run *r)
{
    const qdot_ode_stats *s = &r->result->stats;

    if (!r->options->judged || s->rejected < taken_back || s->rejected < s->steps / 2)
        return QDOT_OK;
    r->result->unfit = true;
    return qdot_fail(QDOT_ELIMIT,
                     "stopped at t = %.4g: first orders in two doubles do not agree with the others there",
                     r->t);
}

/* List the addresses of the pointers to all arrays that a run allocates. */
static void
list_allocated_arrays(run *r, double ***arrays)
{
    arrays[0] = &r->y;
    arrays[1] = &r->carry;
    arrays[2] = &r->scale;
    arrays[3] = &r->next;
    arrays[4] = &r->next_carry;
    arrays[5] = &r->next_size;
    arrays[6] = &r->next_scale;
    arrays[7] = &r->slope;
    arrays[8] = &r->terms;
    arrays[9] = &r->least;
}

static qdot_status
taylor_make_room(run *r)
{
    const qdot_ode_following *f = r->system->following;
    double **arrays[ARRAYS];

    list_allocated_arrays(r, arrays);
    for (size_t i = 0; i < ARRAYS; i++) {
        *arrays[i] = qdot_calloc(r->n + 8, sizeof(double));
        if (!*arrays[i])
            return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < r->n + 8; i++)
        r->least[i] = i < r->n ? qdot_ode_scale(r->system->scales, i) : 1;
    r->confirmed = qdot_calloc(r->n, sizeof *r->confirmed);
    if (!r->confirmed)
        return QDOT_ENOMEM;
    for (size_t i = r->series->checked; i < r->n; i++) {
        bool follows = false;

        for (size_t k = 0; f && k < f->n; k++)
            follows = follows || f->index[k] == i;
        if (!follows)
            r->confirmed[r->n_confirmed++] = i;
    }
    qdot_ode_taylor_run_set_arrays(r);
    return QDOT_OK;
}

static qdot_status
taylor_prepare(run *r, double t0, double t1, const double *y)
{
    const double term_tol = r->options->term_tol != 0 ? r->options->term_tol : r->tol;

    QDOT_TRY(qdot_ode_check_limits(r->system, t0, t1, y));
    if (r->n == 0)
        return qdot_fail(QDOT_EINVAL, "there is nothing to integrate");
    if (!r->series)
        return qdot_fail(QDOT_EINVAL, "taylor needs the Taylor series of the equations");
    QDOT_TRY(qdot_ode_check_tolerance(r->tol));
    QDOT_TRY(taylor_make_room(r));
    memcpy(r->y, y, r->n * sizeof *y);
    if (r->options->carry)
        memcpy(r->carry, r->options->carry, r->n * sizeof *y);
    for (size_t i = 0; i < r->n; i++)
        r->scale[i] = 1 / qdot_ode_size(r->least, i, y[i]);
    r->log_wanted = log2(qdot_step_aim(r->tol, r->options->leading));
    r->log_term = qdot_step_term(log2(qdot_step_aim(term_tol, r->options->leading)));
    r->most = r->next_p = qdot_ode_taylor_order(r->series, r->tol, r->options->leading, r->options->order_more);
    qdot_ode_taylor_run_set_order(r, r->most);
    r->highest = qdot_ode_taylor_highest(r->system, r->tol, r->options->leading,
                                         r->options->order_more);
    r->work = qdot_ode_expansion_work(r->series, r->p);
    return r->series->prepare ? r->series->prepare(r->p, r->series->user) : QDOT_OK;
}

static void
taylor_release(run *r)
{
    double **arrays[ARRAYS];

    list_allocated_arrays(r, arrays);
    for (size_t i = 0; i < ARRAYS; i++)
        qdot_free(*arrays[i]);
    qdot_free(r->confirmed);
    qdot_ode_stiffness_clear(&r->stiffness);
}

/* Make the data of an integration that has not begun yet. */
static run
make_run(const qdot_ode_system *system, const qdot_ode_options *options, double t0, double t1,
         qdot_ode_result *result)
{
    return (run){.system = system,
                 .series = system->series,
                 .kernels = qdot_series_kernels_get(),
                 .options = options,
                 .result = result,
                 .n = system->n,
                 .tol = qdot_ode_tolerance(options),
                 .max_steps = qdot_ode_most_steps(options),
                 .t = t0,
                 .t0 = t0,
                 .crawl.t = t0,
                 .t1 = t1,
                 .direction = t1 < t0 ? -1 : 1,
                 .unit = 1,
                 .place = NAN,
                 .undefined_at = NAN};
}

qdot_status
qdot_ode_taylor_first_step(const qdot_ode_system *system, const qdot_ode_options *options,
                           double t, double t1, const double *y, double *h)
{
    const qdot_ode_options plain = {.tol = options->tol, .goes_on = true};
    qdot_ode_result result = {0};
    run r = make_run(system, &plain, t, t1, &result);
    qdot_status status = taylor_prepare(&r, t, t1, y);

    *h = 0;
    if (status == QDOT_OK) {
        qdot_ode_taylor_run_set_unit(&r, r.direction);
        status = qdot_ode_taylor_run_begin(&r, t, r.y);
    }
    r.until = qdot_ode_until(system, t, t1);
    if (status == QDOT_OK)
        status = qdot_ode_taylor_run_length(&r, INFINITY, h);
    taylor_release(&r);
    if (status != QDOT_OK)
        *h = 0;
    return qdot_grave(status);
}

/* --- the controller ------------------------------------------------------------------ */

/* Begin the series at the start. */
static qdot_status
begin_first_series(run *r)
{
    qdot_status status;

    if (r->options->h_first > 0)
        r->unit = qdot_step_unit(r->options->h_first);
    r->first_unit = r->direction * fabs(r->unit);
    r->written = qdot_ode_written_begin(r->series, r->p, r->highest, r->options->past);
    qdot_ode_taylor_run_set_unit(r, r->first_unit);
    status = qdot_ode_taylor_run_begin(r, r->t, r->y);
    if (!qdot_ode_may_be_undefined(status))
        return status;
    r->undefined = *qdot_last_error();
    return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t, r->undefined.message);
}

static qdot_status
taylor_open(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options,
            double t0, double t1, const double *y, qdot_ode_result *result, void **out)
{
    run *r = qdot_malloc(sizeof *r);

    *out = r;
    if (!r)
        return QDOT_ENOMEM;
    *r = make_run(system, options, t0, t1, result);
    r->method = method;
    QDOT_TRY(taylor_prepare(r, t0, t1, y));
    QDOT_TRY(qdot_ode_enter(system, options, t0, y));
    return t0 != t1 ? begin_first_series(r) : QDOT_OK;
}

static qdot_status
taylor_offer(void *run_, qdot_ode_step *step)
{
    run *r = run_;
    const bool fixed = r->options->h_fixed > 0;
    double h, end;
    bool good = false, ends;

    if (r->attempt.tries == 0) {
        r->attempt.most = INFINITY;
        r->attempt.before = 0;
        r->until = fixed ? r->t1 : qdot_ode_until(r->system, r->t, r->t1);
    }
    for (;;) {
        qdot_status status;

        QDOT_TRY(qdot_interrupt_check());
        if (r->result->stats.steps + r->result->stats.rejected >= r->max_steps)
            return qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g after %llu steps", r->t,
                             (unsigned long long)r->max_steps);
        status = find_length(r, &h);
        if (status != QDOT_OK) {
            r->attempt.h = fabs(r->unit); /* the start point itself is good: f is undefined only beyond it */
            QDOT_TRY(prepare_another_attempt(r, status));
            continue;
        }
        r->defect = 0;
        ends = isinf(h);
        h = qdot_smaller(h, r->attempt.most);
        end = qdot_step_end(r->t, r->until, r->direction, h, fixed);
        r->attempt.h = r->direction * (end - r->t);
        if (end != r->until && qdot_step_is_too_short(r->t, r->attempt.h))
            return taylor_too_small(r);
        good = true;
        if (ends && !fixed) /* the series may be the whole solution, or hide one */
            status = qdot_ode_taylor_run_is_confirmed_inside(r, end - r->t, &good);
        if (status == QDOT_OK && good)
            break;
        QDOT_TRY(prepare_another_attempt(r, status));
    }
    r->expanded = (qdot_ode_expanded){
        r->t, end, r->unit, qdot_ode_taylor_last_order(r->system, r->cut), r->y, r->carry, r->t + r->direction * h};
    *step = (qdot_ode_step){.method = r->method, .series = &r->expanded, .t_end = end};
    return QDOT_OK;
}

static qdot_status
taylor_take(void *run_, qdot_ode_step *step, bool *taken)
{
    run *r = run_;
    const qdot_status status = qdot_ode_taylor_run_go(r, r->expanded.t_end, taken);

    if (status != QDOT_OK || !*taken) {
        *taken = false;
        return prepare_another_attempt(r, status);
    }
    step->t_end = r->expanded.t_end;
    step->y_end = r->next;
    step->low_end = r->next_carry;
    return QDOT_OK;
}

static qdot_status
taylor_accept(void *run_)
{
    run *r = run_;

    if (r->direction * (r->expanded.t_end - r->place) > 0 && r->series->crossed)
        r->series->crossed(r->place, r->series->user);
    r->place = NAN;
    r->t = r->expanded.t_end;
    qdot_ode_taylor_run_accept(r);
    r->result->stats.steps++;
    r->result->stats.projections += r->attempt.moved > 0;
    r->attempt.tries = 0;
    if (r->options->meter)
        QDOT_TRY(report_work(r));
    qdot_progress_at(r->t);
    QDOT_TRY(end_if_two_doubles_do_harm(r));
    QDOT_TRY(qdot_ode_crawl_look(&r->crawl, r->t, r->t1, r->max_steps));
    return qdot_ode_stiffness_is_due(&r->stiffness) ? look_for_stiffness(r) : QDOT_OK;
}

static qdot_status
taylor_refuse(void *run_, qdot_status why)
{
    return prepare_another_attempt(run_, why);
}

static void
taylor_state(void *run_, double *y, double *low)
{
    const run *r = run_;

    memcpy(y, r->y, r->n * sizeof *y);
    if (low)
        memcpy(low, r->carry, r->n * sizeof *low);
}

static void
taylor_close(void *run_)
{
    taylor_release(run_);
    qdot_free(run_);
}

const qdot_ode_control qdot_ode_taylor_steps = {.open = taylor_open,
                                                .offer = taylor_offer,
                                                .take = taylor_take,
                                                .accept = taylor_accept,
                                                .refuse = taylor_refuse,
                                                .state = taylor_state,
                                                .close = taylor_close};
