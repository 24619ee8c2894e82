/* run-doubts.c -- what makes the error of a run unknown, whatever its companions agree on. */
#include "sim/run/run-doubts.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "sim/error/constraint-corners.h"
#include "sim/error/touches.h"
#include "sim/error/unresolved-forces.h"

/* Give the error up, for that reason. */
static qdot_status
lose(qdot_run *run, const char *doubt)
{
    run->hidden = true;
    run->report.error = run->report.scaled_error = run->report.horizon = NAN;
    return qdot_run_say_doubt(run, doubt);
}

/* If a step missed a force, the error is unknown. */
static qdot_status
find_hidden(qdot_run *run)
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
    return lose(run, text);
}

/* If the motion turned round in a constraint's cusp, nothing is known of it from there on. */
static qdot_status
find_corner(qdot_run *run)
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
    return lose(run, text);
}

/* Terms of a series are so many times smaller than its first, with which a step is at its end as large as they count. */
static const double of_series = 0x1p80;

/* Whether the run is so long that what an acceleration loses near the least double would move a coordinate by more than
 * its rounding: x = 1 in a span of 1e142. */
static bool
least_acceleration_moves(const qdot_trajectory *tr)
{
    const double *first = tr->y, *last = tr->y + (tr->count - 1) * tr->n,
                 length = fabs(tr->t[tr->count - 1] - tr->t[0]), way = of_series * 0x1p-1074 * length * length;
    bool moves = false;

    for (size_t i = 0; i < tr->n / 2; i++) {
        const double size = fmax(fabs(first[i]), fabs(last[i]));

        moves = moves || way > (size > 0 ? DBL_EPSILON * size : 1);
    }
    return moves;
}

/* Whether at a point of the run a number of the equations underflows, or an acceleration is so small that its series
 * does. */
static qdot_status
underflows(const qdot_course *course, bool *found)
{
    const double least = of_series * DBL_MIN;
    const qdot_error before = *qdot_last_error();
    const qdot_trajectory *tr = &course->tr;
    double *slope = qdot_malloc(tr->n * sizeof *slope);

    if (slope == NULL)
        return QDOT_ENOMEM;
    *found = false;
    (void)feclearexcept(FE_UNDERFLOW);
    for (size_t k = 0; k < tr->pieces.n; k++) {
        const qdot_ode_system *system = qdot_course_systems(course) + tr->pieces.at[k].mode;
        const size_t end = k + 1 < tr->pieces.n ? tr->pieces.at[k + 1].first : tr->count;

        for (size_t i = tr->pieces.at[k].first; i < end; i++) {
            if (system->rhs(tr->t[i], tr->y + i * tr->n, slope, system->user) != QDOT_OK)
                continue;
            for (size_t j = tr->n / 2; j < tr->n; j++)
                *found = *found || (slope[j] != 0 && fabs(slope[j]) < least);
        }
    }
    *found = *found || fetestexcept(FE_UNDERFLOW) != 0;
    qdot_free(slope);
    qdot_fail_again(&before);
    return QDOT_OK;
}

/* If forces too small for a double would matter in so long a run, the error is unknown. */
static qdot_status
find_underflow(qdot_run *run)
{
    bool found;

    if (run->hidden || run->course.tr.count == 0 || !least_acceleration_moves(&run->course.tr))
        return QDOT_OK;
    QDOT_TRY(underflows(&run->course, &found));
    return found ? lose(run, "forces are near the least double or below it, and what is lost of them counts in so long a "
                             "run: other units, or `digits 20`")
                 : QDOT_OK;
}

qdot_status
qdot_run_doubt_places(qdot_run *run)
{
    QDOT_TRY(find_hidden(run));
    QDOT_TRY(find_corner(run));
    return find_underflow(run);
}

qdot_status
qdot_run_doubt_end(qdot_run *run)
{
    run->report.error = run->report.scaled_error = NAN;
    return qdot_run_say_doubt(run, "the run ended at a singularity, and how far from it, rounding decides");
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
    return lose(run, "the energy, which is conserved, has not been kept: a step came within tol of a "
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
