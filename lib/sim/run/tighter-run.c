/* tighter-run.c -- repeats a run with a tighter tolerance if some digits are then correct at its end. */
#include "sim/run/tighter-run.h"

#include <math.h>

#include "ode/scale.h"
#include "sim/course/run-state.h"

static const double tightest = 1e-15;

/* A run with more work than this (in units of about 1 ns) is not repeated. */
static const double most_work = 1e9;

/* Power law of the error growth: its exponent is at most `most_power`, the same within `alike` at
 * half the time; `few` is the error allowed at the end. */
static const double most_power = 4, alike = 1.5, few = 1e-2;
enum { looked_at = 16 };

/* The largest scaled distance, over all components, of the run from its companion run at t; NAN: unknown. */
static double
distance_from_companion(const qdot_run *run, double t)
{
    const size_t n = run->course.tr.n;
    double *y = qdot_calloc(2 * n, sizeof *y), most = NAN;

    if (y && run->has_companion
        && qdot_trajectory_at(&run->course.tr, qdot_course_systems(&run->course), t, y) == QDOT_OK
        && qdot_trajectory_at(&run->companion.tr, qdot_course_systems(&run->companion), t, y + n)
               == QDOT_OK)
        for (size_t i = 0; i < n; i++)
            most = fmax(most, fabs(y[i] - y[n + i]) / qdot_ode_size(run->stage.scales, i, y[i]));
    qdot_free(y);
    return most;
}

/* The largest distance between run and companion run at times t to 2 t, as it oscillates along an orbit. */
static double
largest_distance_after(const qdot_run *run, double t)
{
    double most = NAN;

    for (int k = 1; k <= looked_at; k++)
        most = fmax(most, distance_from_companion(run, run->t0 + t * (1 + (double)k / looked_at)));
    return most;
}

/* The power of t with which the distance of neighbouring motions grows before the horizon; INFINITY: it grows
 * faster. */
static double
exponent_of_error_growth(const qdot_run *run)
{
    const double h = run->report.horizon - run->t0;
    const double of[] = {largest_distance_after(run, h / 8), largest_distance_after(run, h / 4), largest_distance_after(run, h / 2)};
    const double early = log2(of[1] / of[0]), late = log2(of[2] / of[1]);

    return late < most_power && fabs(late - early) < alike ? fmax(late, early) : INFINITY;
}

/* Whether the run can be repeated with the tightest tolerance. */
static bool
can_be_tighter(const qdot_run *run, const qdot_run_request *request)
{
    return run->plan->chosen && run->plan->method->series && !request->no_drifts
           && !request->by_clock && run->report.status != QDOT_RUN_FAILED
           && run->meter.work < most_work && request->tol > tightest;
}

/* Whether a tighter tolerance probably keeps digits to the end, if errors grow exponentially, or as
 * a power of t. */
static bool
is_repetition_promising(const qdot_run *run, const qdot_run_request *request)
{
    const double known = (run->report.horizon - run->t0) / (run->t1 - run->t0);

    return known * log(tightest) / log(request->tol) > 1
           || tightest / request->tol * pow(known, -exponent_of_error_growth(run)) < few;
}

static qdot_status
add_notice_of_tighter_run(qdot_run *run, const qdot_run_request *request, double lost)
{
    qdot_text *to = qdot_run_next_notice(run);

    qdot_text_format(to, "tol %.3g would leave ", request->tol);
    if (isnan(lost))
        qdot_text_add(to, "the error unknown");
    else
        qdot_text_format(to, "no digit beyond t = %.4g", lost);
    qdot_text_format(to, ": the run is under tol %.3g", tightest);
    return qdot_text_status(to);
}

qdot_status
qdot_run_tighten(qdot_scene *scene, const qdot_run_request *request, const qdot_run_maker *by,
                 qdot_run **run)
{
    const double lost = (*run)->report.horizon;
    qdot_run_request tighter = *request;
    qdot_run *other = NULL;
    qdot_status status;

    if (!can_be_tighter(*run, request)
        || (isnan(lost) ? !isnan((*run)->report.error) : !is_repetition_promising(*run, request)))
        return QDOT_OK;
    tighter.tol = tightest;
    status = by->make(scene, &tighter, &other);
    if (status == QDOT_OK && isnan(other->report.horizon) && !isnan(other->report.error)
        && other->report.status != QDOT_RUN_FAILED) {
        by->free(*run);
        *run = other;
        return add_notice_of_tighter_run(*run, request, lost);
    }
    by->free(other);
    return qdot_grave(status);
}
