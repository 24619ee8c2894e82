/* run-doubts.c -- finds reasons why a run's error is unknown even if its companion runs agree with it. */
#include "sim/run/run-doubts.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "sim/error/constraint-corners.h"
#include "sim/error/touches.h"
#include "sim/error/unresolved-forces.h"

/* Mark the error of the run as unknown, for the given reason. */
static qdot_status
mark_error_unknown(qdot_run *run, const char *doubt)
{
    run->hidden = true;
    run->report.error = run->report.scaled_error = run->report.horizon = NAN;
    return qdot_run_say_doubt(run, doubt);
}

/* Mark the error of the run as unknown if a step missed a short force. */
static qdot_status
check_missed_forces(qdot_run *run)
{
    const qdot_error before = *qdot_last_error();
    char text[200];
    bool found;
    double t;

    QDOT_TRY(qdot_unresolved_forces_find(&run->course, &found, &t));
    qdot_fail_again(&before);
    if (!found)
        return QDOT_OK;
    snprintf(text, sizeof text,
             "a force acts about t = %.6g for less than a step, which went over it: %s", t,
             run->plan->method->series ? "end a run just before, and go on from there"
                                       : "method taylor looks for such places");
    return mark_error_unknown(run, text);
}

/* Make the error unknown if the motion reversed at a cusp of a constraint, after which its course
 * is unknown. */
static qdot_status
check_constraint_corners(qdot_run *run)
{
    bool found;
    char text[300];
    size_t row;
    double t;

    if (run->hidden)
        return QDOT_OK;
    QDOT_TRY(qdot_constraint_corners_find(&run->course, &found, &t, &row));
    if (!found)
        return QDOT_OK;
    snprintf(text, sizeof text,
             "constraint %.100s has no direction about t = %.6g, a cusp of it, and what the motion is "
             "from there is not determined",
             run->plan->constraints->rows[row].name, t);
    return mark_error_unknown(run, text);
}

/* Make the error unknown if an event with a direction touches 0 within rounding, so that it may not
 * occur there. */
static qdot_status
check_touching_events(qdot_run *run)
{
    const qdot_course *c = &run->course;
    char text[300];

    for (size_t k = 0; k < c->faded.n && !run->hidden; k++) {
        const qdot_staged_event *e = &run->stage.events.at[c->faded.at[k].event];

        if (!c->faded.at[k].touched || !qdot_staged_event_acts(e))
            continue;
        snprintf(text, sizeof text,
                 "about t = %.6g the event %.100s touches within rounding, so that whether it acts there is not known",
                 c->faded.at[k].from, e->name);
        return mark_error_unknown(run, text);
    }
    return QDOT_OK;
}

/* Terms of a series are so many times smaller than its first, with which a step is at its end as large as they
 * count. */
static const double of_series = 0x1p80;

/* Whether an acceleration that is off by so much all along the run may move coordinate i, of so many, by more than its
 * rounding. */
static bool
acceleration_exceeds(const qdot_trajectory *tr, size_t i, double off)
{
    const double size = fmax(fabs(tr->y[i]), fabs(tr->y[(tr->count - 1) * tr->n + i])),
                 length = fabs(tr->t[tr->count - 1] - tr->t[0]);

    return off != 0 && !(off * length * length <= (size > 0 ? DBL_EPSILON * size : 1));
}

/* Whether the run is so long that what a series of accelerations loses near the least double would move a coordinate:
 * x = 1 in a span of 1e142. */
static bool
least_acceleration_exceeds(const qdot_trajectory *tr)
{
    bool moves = false;

    for (size_t i = 0; i < tr->n / 2; i++)
        moves = moves || acceleration_exceeds(tr, i, of_series * DBL_TRUE_MIN);
    return moves;
}

static void
forget_underflows(void)
{
#ifdef FE_UNDERFLOW
    (void)feclearexcept(FE_UNDERFLOW);
#endif
}

/* Whether an operation has underflowed since; perhaps on a machine without the flags of IEEE 754, as WebAssembly is. */
static bool
may_have_underflowed(void)
{
#ifdef FE_UNDERFLOW
    return fetestexcept(FE_UNDERFLOW) != 0;
#else
    return true;
#endif
}

/* Whether at this point of the run a number of the equations underflows in a way that moves a coordinate, or, beside a
 * run so `long_` that any such loss does, underflows at all or has an acceleration so small that its series does.
 *   a [n]  room for q'' and for what it loses */
static qdot_status
check_underflow_at_point(const qdot_course *course, const qdot_ode_system *system, size_t k, bool is_long, double *a, bool *found)
{
    const qdot_trajectory *tr = &course->tr;
    const size_t n = tr->n / 2;
    const double *y = tr->y + k * tr->n, least = of_series * DBL_MIN;

    forget_underflows();
    if (qdot_bind_accelerations(system, tr->t[k], y, a) != QDOT_OK)
        return QDOT_OK;
    for (size_t j = 0; j < n && is_long; j++)
        *found = *found || (a[j] != 0 && fabs(a[j]) < least);
    if (!may_have_underflowed() || *found)
        return QDOT_OK;
    *found = is_long;
    QDOT_TRY(qdot_bind_underflows(system, tr->t[k], y, a, a + n));
    for (size_t j = 0; j < n; j++)
        *found = *found || acceleration_exceeds(tr, j, a[n + j]);
    return QDOT_OK;
}

/* Mark the error as unknown if forces too small for a double would change the run. */
static qdot_status
check_underflow(qdot_run *run)
{
    enum { PLACES = 32 };
    const qdot_course *course = &run->course;
    const qdot_trajectory *tr = &course->tr;
    const qdot_error before = *qdot_last_error();
    const bool is_long = tr->count > 0 && least_acceleration_exceeds(tr);
    const size_t step = is_long || tr->count < PLACES ? 1 : (tr->count + PLACES - 1) / PLACES;
    double *a;
    qdot_status status = QDOT_OK;
    bool found = false;

    if (run->hidden || tr->count == 0 || (!is_long && (!run->plan->tape || run->plan->constraints)))
        return QDOT_OK;
    a = qdot_calloc(tr->n + (run->plan->constraints ? run->plan->constraints->m : 0) + 1, sizeof *a);
    if (a == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < tr->count && !found && status == QDOT_OK; k += step) {
        const size_t mode = tr->pieces.at[qdot_trajectory_piece_of(tr, k)].mode;

        status = check_underflow_at_point(course, qdot_course_systems(course) + mode, k, is_long, a, &found);
    }
    qdot_free(a);
    if (status == QDOT_OK)
        qdot_fail_again(&before);
    return status == QDOT_OK && found
               ? mark_error_unknown(run, "forces are as small as the least double or smaller, and their rounding errors matter in this run: "
                                          "other units, or `digits 20`")
               : status;
}

qdot_status
qdot_run_doubt_places(qdot_run *run)
{
    QDOT_TRY(check_missed_forces(run));
    QDOT_TRY(check_constraint_corners(run));
    QDOT_TRY(check_touching_events(run));
    return check_underflow(run);
}

qdot_status
qdot_run_doubt_end(qdot_run *run)
{
    run->report.error = run->report.scaled_error = NAN;
    return qdot_run_say_doubt(run, "the run ended at a singularity, and rounding decides how far from it");
}

qdot_status
qdot_run_doubt_energy(qdot_run *run, double tol)
{
    const qdot_trajectory *tr = &run->course.tr;
    bool contradict;

    if (run->hidden || isnan(run->report.error))
        return QDOT_OK;
    QDOT_TRY(qdot_drifts_contradict(&run->drifts, run->plan, tr,
                                    fmax(tol, tr->result.stats.raised), &contradict));
    if (!contradict)
        return QDOT_OK;
    return mark_error_unknown(run, "the energy, which is conserved, has not been kept: a step came within tol of a "
                                    "place where the equations are singular, or went over it");
}

qdot_status
qdot_run_decide_touches(qdot_run *run, double *tol)
{
    qdot_status status = QDOT_OK;

    if (run->course.passed_over > 0)
        *tol = fmin(*tol, 0.5 * run->course.passed_over);
    for (size_t i = 0; i < run->stage.events.n && status == QDOT_OK; i++)
        status = qdot_touches_look(run, i, NULL, tol);
    return qdot_grave(status);
}
