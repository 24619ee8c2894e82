/* taylor.c -- integrates by Taylor series: order, length and check of steps, compensated sums. */
#include "ode/taylor.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "ode/leading.h"
#include "ode/meter.h"
#include "ode/scale.h"
#include "ode/taylor-numbers.h"
#include "ode/taylor-run.h"

enum { ARRAYS = 10 };

typedef qdot_ode_taylor_run run;

/* A projection onto the constraints moves a state by about its own rounding error, whatever the tolerance. */
static const double rounding_of_projection = 1e-13;

/* A defect that falls by less than this when the step is divided by 4 is noise, if it is less than
 * this of the state over the step. */
static const double falls = 0.125, most_noise = 1e-5;

/* After this many rejected steps the lowest orders of the series are no longer computed in two doubles. */
enum { taken_back = 100 };

/* The largest number of attempts at a point beyond which f is undefined, each with a quarter of the step before. */
static const int max_undefined = 60;

/* --- the state at the end of a step ------------------------------------------------- */

/* Compute next = y + carry + sum_{k>=1} x_k s^k up to the given order, and the time derivative of this sum. */
static void
advance_state(run *r, int order, double s)
{
    r->step.x = r->series->x; /* read the address again: a `begin` may have changed where the series is stored */
    r->step.stride = r->series->stride;
    r->step.p = order;
    r->step.s = s;
    r->step.unit = r->unit;
    r->kernels->advance(&r->step);
}

/* Set the pointers in r->step to the arrays that are in use now. */
static void
set_step_arrays(run *r)
{
    r->step = (qdot_series_step){.n = r->n,
                                 .linked = r->series->checked,
                                 .y = r->y,
                                 .carry = r->carry,
                                 .next = r->next,
                                 .next_carry = r->next_carry,
                                 .least = r->least,
                                 .size = r->next_size,
                                 .scale = r->next_scale,
                                 .slope = r->slope,
                                 .terms = r->terms};
}

/* Accept the step just tried: its end becomes the present state. */
static void
accept_taylor_step(run *r)
{
    qdot_swap(&r->y, &r->next);
    qdot_swap(&r->carry, &r->next_carry);
    qdot_swap(&r->scale, &r->next_scale);
    r->step.y = r->y;
    r->step.carry = r->carry;
    r->step.next = r->next;
    r->step.next_carry = r->next_carry;
    r->step.scale = r->next_scale;
}

/* Update the size and the scale (1/size) of component i after a change of the state. */
static void
update_size(run *r, size_t i)
{
    r->next_size[i] = qdot_ode_size(r->least, i, r->next[i]);
    r->next_scale[i] = 1 / r->next_size[i];
}

/* --- confirmation of a step --------------------------------------------------------- */

/* Whether the polynomials of components that are not integrated, at the end, in r->next, agree with
 * their derived values there. These may be sensitive to rounding of the others, so this only detects
 * a wrong series. */
static bool
derived_components_agree(const run *r, double h, double share)
{
    const qdot_ode_following *f = r->system->following;

    for (size_t k = 0; f && k < f->n; k++) {
        const size_t i = f->index[k];
        double P = r->next[i], now = r->series->x[i * r->series->stride];

        if (!(fabs((P - now) * h) <=
              share * qdot_ode_size(r->least, i, P) + 0x1p-26 * (fabs(P) + fabs(now)) * fabs(h)))
            return false;
    }
    return true;
}

/* Whether the slope of the polynomial, in r->slope over that part of the step h, is that of
 * the equations begun anew at its end. */
static bool
is_confirmed_at_end(const run *r, double h, double part, double old_held)
{
    const qdot_ode_series *series = r->series;
    const double now = part * h * r->per_unit, rounding = 64 * DBL_EPSILON;
    const double share = part * (10 * (r->p + 1) * qdot_larger(r->held, old_held)
                                 + r->noise * fabs(h));

    for (size_t k = 0; k < r->n_confirmed; k++) {
        const size_t i = r->confirmed[k];
        const double f = series->x[i * series->stride + 1] * now;

        if (!(fabs(r->slope[i] - f) <= share * r->next_size[i] + rounding * r->terms[i]))
            return false;
    }
    return derived_components_agree(r, part * h, share);
}

/* The largest defect of a component at the end of the step: the error of its time derivative, relative to its size. */
static double
find_defect(const run *r, double h)
{
    const double now = h * r->per_unit;
    double most = 0;

    for (size_t k = 0; k < r->n_confirmed; k++) {
        const size_t i = r->confirmed[k];
        const double f = r->series->x[i * r->series->stride + 1] * now;

        most = fmax(most, fabs(r->slope[i] - f) / r->next_size[i]);
    }
    return most / fabs(h);
}

/* Whether the step does no more than go over a time at which f jumps (`until` of ode/system.h): nothing can be confirmed. */
static bool
is_over_jump(const run *r, double h)
{
    static const double nothing = 1e-11;

    return r->system->until && fabs(h) <= nothing * fabs(r->t1 - r->t0);
}

/* Whether it also is inside the step, at places without a pattern. The series is
 * begun anew at y afterwards. */
static qdot_status
is_confirmed_inside(run *r, double h, bool *good)
{
    static const double places[] = {0.31830988618379067, 0.70710678118654752};
    const double old_held = r->held;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < 2 && *good && status == QDOT_OK; k++) {
        advance_state(r, r->p, places[k] * h / r->unit);
        status = qdot_ode_taylor_run_begin(r, r->t + places[k] * h, r->next);
        if (status == QDOT_OK) {
            *good = is_confirmed_at_end(r, h, places[k], old_held);
            status = qdot_ode_taylor_run_begin(r, r->t, r->y);
        }
        if (status == QDOT_OK)
            status = qdot_ode_taylor_run_expand(r);
    }
    return status;
}

/* Project the state at the end of the step just tried onto the constraints; *moved: how far it moved. */
static qdot_status
project_end_of_step(run *r, double t_end, double *moved)
{
    double undefined = 0;

    *moved = 0;
    for (size_t i = 0; i < r->n; i++)
        undefined += r->next[i] - r->next[i];
    if (undefined != 0)
        return qdot_fail(QDOT_EDOMAIN, "the solution exceeds the largest double");
    if (!r->system->project)
        return QDOT_OK;
    QDOT_TRY(r->system->project(t_end, r->next, r->next_carry, moved, r->system->user));
    for (size_t i = 0; i < r->n && *moved > 0; i++)
        update_size(r, i);
    return QDOT_OK;
}

/* Compute, at the end of the step, those components that are functions of the others. */
static void
derive_components(run *r)
{
    const qdot_ode_following *f = r->system->following;

    for (size_t k = 0; f && k < f->n; k++) {
        const size_t i = f->index[k];

        r->next[i] = r->series->x[i * r->series->stride];
        r->next_carry[i] = 0;
        update_size(r, i);
    }
}

/* Generate machine code for the expansions if the steps so far suggest that many more will follow. */
static qdot_status
generate_code_if_useful(run *r, double t)
{
    const double steps = (double)r->result->stats.steps + 1;

    return qdot_ode_written_next(&r->written, steps, steps * (r->t1 - t) / (t - r->t0));
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

/* Recompute the state at the end of the step with the first orders of the series in two doubles. */
static qdot_status
advance_in_two_doubles(run *r, double t_end)
{
    qdot_ode_leading_step step = {.system = r->system,
                                  .at = {r->t, r->t == r->t0 ? r->options->t0_low : 0, r->y,
                                         r->carry},
                                  .unit = r->unit,
                                  .eps = exp2(r->log_wanted),
                                  .scale = r->scale,
                                  .p = r->cut};

    step.h = qdot_two_rounded_sum(t_end, -r->t, &step.h_low);
    step.h_low += (t_end == r->t1 ? r->options->t1_low : 0) - step.at.t_low;
    return qdot_ode_leading_advance(&step, r->next, r->next_carry);
}

/* Noise that a step did not meet any more is forgotten, little by little; with that which it met,
 * it was held to no more than `raised`. */
static void
record_noise_of_step(run *r, double h, double old_held)
{
    const double defect = find_defect(r, h);
    const double raised = defect * fabs(h) / (10 * (r->p + 1));

    if (raised > qdot_larger(r->held, old_held)) {
        qdot_ode_stats *stats = &r->result->stats;

        stats->raised = qdot_larger(stats->raised, raised);
    }
    if (defect < r->noise / 8)
        r->noise /= 2;
}

/* A step whose defect, over its length, hardly falls when it is divided by 4, as truncation would
 * by 4^p, meets the rounding of the equations: shorter ones err as much. *most: the length that it
 * then may have again. */
static bool
is_defect_only_noise(run *r, double before, double h, double *most)
{
    const double noise = 2 * qdot_larger(r->defect, before);

    if (!(before > 0 && r->defect > falls * before && noise * 4 * h < most_noise))
        return false;
    r->noise = qdot_larger(r->noise, noise);
    *most = 4 * h;
    return true;
}

/* Try a step of h from t to t_end, where one of `longest` would do. On QDOT_OK and *good it has been accepted, and the
 * series is begun at its end. Otherwise only the series has changed. */
static qdot_status
taylor_try_step(run *r, double h, double t_end, double longest, bool unsure, bool *good)
{
    const double old_held = r->held;
    const bool fixed = r->options->h_fixed > 0;
    double moved;
    qdot_status status;

    *good = true;
    if (unsure && !fixed)
        QDOT_TRY(is_confirmed_inside(r, h, good));
    if (!*good)
        return QDOT_OK;
    if (r->options->expanded) {
        qdot_ode_expanded step = {
            r->t, t_end, r->unit, qdot_ode_taylor_last_order(r->system, r->cut), r->y, r->carry, r->t + r->direction * longest};

        QDOT_TRY(r->options->expanded(&step, r->options->user));
        t_end = step.t_end;
        h = t_end - r->t;
    }
    if (t_end == r->t1)
        h += r->options->t1_low; /* compute the defect over the full length of the step, t1_low included */
    advance_state(r, r->cut, h * r->per_unit);
    if (r->options->leading)
        QDOT_TRY(advance_in_two_doubles(r, t_end));
    QDOT_TRY(project_end_of_step(r, t_end, &moved));
    *good = fixed || is_over_jump(r, h) || moved <= 100 * r->held + rounding_of_projection;
    if (!*good)
        return QDOT_OK;
    qdot_ode_taylor_run_set_unit(r, qdot_step_unit(h));
    QDOT_TRY(generate_code_if_useful(r, t_end));
    status = qdot_ode_taylor_run_begin(r, t_end, r->next);
    if (status == QDOT_OK)
        *good = fixed || is_over_jump(r, h) || is_confirmed_at_end(r, h, 1, old_held);
    if (status == QDOT_OK && !*good)
        r->defect = find_defect(r, h);
    if (status == QDOT_OK && *good && r->noise > 0)
        record_noise_of_step(r, h, old_held);
    if (status == QDOT_OK && *good)
        derive_components(r);
    if (status == QDOT_OK && *good && r->options->accepted) {
        bool stop = false;

        if (r->options->beyond)
            *r->options->beyond = r->next_carry;
        status = r->options->accepted(t_end, r->next, &stop, r->options->user);
        if (stop)
            r->result->outcome = QDOT_ODE_STOPPED;
    }
    if (status != QDOT_OK || !*good)
        return status;
    if (r->direction * (t_end - r->place) > 0 && r->series->crossed)
        r->series->crossed(r->place, r->series->user);
    r->place = NAN;
    r->t = t_end;
    accept_taylor_step(r);
    r->result->stats.steps++;
    r->result->stats.projections += moved > 0;
    return QDOT_OK;
}

/* --- the loop over steps ------------------------------------------------------------ */

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

/* The end of a step of length h, rounded to a double; if it is near r->until, that. */
static double
end_of_step(const run *r, double h)
{
    double rest = r->direction * (r->until - r->t), end;

    if (h >= rest * (1 - 1e-12))
        return r->until;
    end = r->t +
          r->direction * (h > 0.5 * rest && !(r->options->h_fixed > 0) ? 0.5 * rest : h);
    return r->direction * (r->until - end) > 0 ? end : r->until;
}

/* Make one step from the present state. */
static qdot_status
taylor_advance(run *r)
{
    double h = 0, most = INFINITY, before = 0;

    r->until = r->options->h_fixed > 0 ? r->t1 : qdot_ode_until(r->system, r->t, r->t1);
    for (int tries = 0;; tries++) {
        double end, longest;
        bool good = false, unsure;
        qdot_status status = QDOT_OK;

        QDOT_TRY(qdot_interrupt_check());
        if (r->result->stats.steps + r->result->stats.rejected >= r->max_steps)
            return qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g after %llu steps", r->t,
                             (unsigned long long)r->max_steps);
        if (tries > 0) { /* a further attempt: compute the series again, as it now belongs to another point */
            qdot_ode_taylor_run_set_unit(r, r->direction * qdot_step_unit(most));
            status = qdot_ode_taylor_run_begin(r, r->t, r->y);
        }
        if (status == QDOT_OK)
            status = qdot_ode_taylor_run_length(r, most, &h);
        if (status == QDOT_OK && r->written.first)
            status = decide_code_by_first_step(r, most, &h);
        if (status == QDOT_OK) {
            r->defect = 0;
            unsure = isinf(h);
            longest = h = qdot_smaller(h, most);
            end = end_of_step(r, h);
            h = r->direction * (end - r->t);
            if (end != r->until && qdot_step_is_too_short(r->t, h))
                return taylor_too_small(r);
            status = taylor_try_step(r, end - r->t, end, longest, unsure, &good);
            if (status == QDOT_OK && good)
                return QDOT_OK;
        } else if (qdot_ode_may_be_undefined(status)) {
            /* the start point itself is good: f is undefined only beyond it */
            h = fabs(r->unit);
        }
        if (status != QDOT_OK && !qdot_ode_may_be_undefined(status))
            return status;
        r->result->stats.rejected++;
        if (status != QDOT_OK) {
            r->undefined = *qdot_last_error();
            r->undefined_at = r->t + r->direction * h;
        }
        if (status == QDOT_OK && is_defect_only_noise(r, before, h, &most))
            continue;
        before = status == QDOT_OK ? r->defect : 0;
        most = 0.25 * h;
        if (tries == max_undefined || most < qdot_step_floor(r->t) ||
            r->options->h_fixed > 0)
            return taylor_too_small(r);
    }
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

static qdot_status
taylor_loop(run *r)
{
    qdot_status status;

    if (r->t == r->t1)
        return QDOT_OK;
    if (r->options->h_first > 0)
        r->unit = qdot_step_unit(r->options->h_first);
    r->first_unit = r->direction * fabs(r->unit);
    r->written = qdot_ode_written_begin(r->series, r->p, r->highest, r->options->past);
    qdot_ode_taylor_run_set_unit(r, r->first_unit);
    status = qdot_ode_taylor_run_begin(r, r->t, r->y);
    if (qdot_ode_may_be_undefined(status)) {
        r->undefined = *qdot_last_error();
        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", r->t, r->undefined.message);
    }
    QDOT_TRY(status);
    while (r->t != r->t1 && r->result->outcome != QDOT_ODE_STOPPED) {
        QDOT_TRY(taylor_advance(r));
        if (r->options->meter)
            QDOT_TRY(report_work(r));
        qdot_progress_at(r->t);
        QDOT_TRY(end_if_two_doubles_do_harm(r));
        QDOT_TRY(qdot_ode_crawl_look(&r->crawl, r->t, r->t1, r->max_steps));
        if (qdot_ode_stiffness_is_due(&r->stiffness))
            QDOT_TRY(look_for_stiffness(r));
    }
    return QDOT_OK;
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
    set_step_arrays(r);
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

qdot_status
qdot_ode_taylor_integrate(const qdot_ode_system *system, const qdot_ode_options *options,
                          double t0, double t1, double *y, qdot_ode_result *result)
{
    static const qdot_ode_options defaults = {0};
    double cpu_start = qdot_cpu_now();
    run r = make_run(system, options ? options : &defaults, t0, t1, result);
    qdot_status status;

    *result = (qdot_ode_result){.outcome = QDOT_ODE_DONE, .t = t0};
    status = taylor_prepare(&r, t0, t1, y);
    if (status == QDOT_OK)
        status = qdot_ode_enter(system, r.options, t0, y);
    if (status == QDOT_OK) {
        status = taylor_loop(&r);
        memcpy(y, r.y, r.n * sizeof *y);
        if (r.options->end_low)
            memcpy(r.options->end_low, r.carry, r.n * sizeof *y);
    }
    taylor_release(&r);
    result->stats.cpu = qdot_cpu_now() - cpu_start;
    qdot_ode_end(result, r.t, status);
    return status;
}
