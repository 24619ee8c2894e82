/* taylor-end.c -- the end of a step by Taylor series: the state there, and whether the step is confirmed. */
#include <float.h>
#include <math.h>

#include "ode/leading.h"
#include "ode/scale.h"
#include "ode/step-decisions.h"
#include "ode/taylor-run.h"

typedef qdot_ode_taylor_run run;

/* A defect that falls by less than this when the step is divided by 4 is noise, if it is less than
 * this of the state over the step. */
static const double falls = 0.125, most_noise = 1e-5;

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
void
qdot_ode_taylor_run_set_arrays(run *r)
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
void
qdot_ode_taylor_run_accept(run *r)
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
    const double now = part * h * r->per_unit;
    const double share = part * (qdot_step_share(r->p, qdot_larger(r->held, old_held)) + r->noise * fabs(h));

    for (size_t k = 0; k < r->n_confirmed; k++) {
        const size_t i = r->confirmed[k];
        const double f = series->x[i * series->stride + 1] * now;

        if (!(fabs(r->slope[i] - f) <= share * r->next_size[i] + qdot_step_rounding * r->terms[i]))
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
qdot_status
qdot_ode_taylor_run_is_confirmed_inside(run *r, double h, bool *good)
{
    const double old_held = r->held;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < QDOT_STEP_PLACES && *good && status == QDOT_OK; k++) {
        advance_state(r, r->p, qdot_step_places[k] * h / r->unit);
        status = qdot_ode_taylor_run_begin(r, r->t + qdot_step_places[k] * h, r->next);
        if (status == QDOT_OK) {
            *good = is_confirmed_at_end(r, h, qdot_step_places[k], old_held);
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
 * by 4^p, meets the rounding of the equations: shorter ones err as much. The longest step to try may
 * then have that length again. */
bool
qdot_ode_taylor_run_meets_noise(run *r)
{
    const double before = r->attempt.before, h = r->attempt.h, noise = 2 * qdot_larger(r->defect, before);

    if (!(before > 0 && r->defect > falls * before && noise * 4 * h < most_noise))
        return false;
    r->noise = qdot_larger(r->noise, noise);
    r->attempt.most = 4 * h;
    return true;
}

/* Go to t_end and begin the series there, if *good. Otherwise only the series has changed. */
qdot_status
qdot_ode_taylor_run_go(run *r, double t_end, bool *good)
{
    const double old_held = r->held;
    const bool fixed = r->options->h_fixed > 0;
    double h = t_end - r->t;

    if (t_end == r->t1)
        h += r->options->t1_low; /* compute the defect over the full length of the step, t1_low included */
    advance_state(r, r->cut, h * r->per_unit);
    if (r->options->leading)
        QDOT_TRY(advance_in_two_doubles(r, t_end));
    QDOT_TRY(project_end_of_step(r, t_end, &r->attempt.moved));
    *good = fixed || is_over_jump(r, h) || r->attempt.moved <= qdot_step_most_moved(r->held);
    if (!*good)
        return QDOT_OK;
    qdot_ode_taylor_run_set_unit(r, qdot_step_unit(h));
    QDOT_TRY(generate_code_if_useful(r, t_end));
    QDOT_TRY(qdot_ode_taylor_run_begin(r, t_end, r->next));
    *good = fixed || is_over_jump(r, h) || is_confirmed_at_end(r, h, 1, old_held);
    if (!*good) {
        r->defect = find_defect(r, h);
        return QDOT_OK;
    }
    if (r->noise > 0)
        record_noise_of_step(r, h, old_held);
    derive_components(r);
    return QDOT_OK;
}
