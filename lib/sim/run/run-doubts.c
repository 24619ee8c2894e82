/* run-doubts.c -- what makes the error of a run unknown, whatever its companions agree on. */
#include "sim/run/run-doubts.h"

#include <math.h>
#include <stdio.h>

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

qdot_status
qdot_run_doubt_places(qdot_run *run)
{
    QDOT_TRY(find_hidden(run));
    return find_corner(run);
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
