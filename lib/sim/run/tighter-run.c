/* tighter-run.c -- repeats a run with a tighter tolerance if digits then remain at its end. */
#include "sim/run/tighter-run.h"

#include <math.h>

#include "ode/scale.h"
#include "sim/course/run-state.h"

static const double tightest = 1e-15;

/* A run with more work than this (about ns) is not repeated. */
static const double most_work = 1e9;

/* Power law of the error growth: its exponent is at most `most_power`, the same within `alike` at
 * half the time; `few` is the error allowed at the end. */
static const double most_power = 4, alike = 1.5, few = 1e-2;
enum { looked_at = 16 };

/* The largest scaled distance of any component of the run from its companion at t; NAN: unknown. */
static double
distance_at(const qdot_run *run, double t)
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

/* The largest distance between t and 2 t, as the distance oscillates along an orbit. */
static double
most_between(const qdot_run *run, double t)
{
    double most = NAN;

    for (int k = 1; k <= looked_at; k++)
        most = fmax(most, distance_at(run, run->t0 + t * (1 + (double)k / looked_at)));
    return most;
}

/* The power of t with which the distance of neighbouring motions grows before the horizon; INFINITY: it grows
 * faster. */
static double
power_of_growth(const qdot_run *run)
{
    const double h = run->report.horizon - run->t0;
    const double of[] = {most_between(run, h / 8), most_between(run, h / 4), most_between(run, h / 2)};
    const double early = log2(of[1] / of[0]), late = log2(of[2] / of[1]);

    return late < most_power && fabs(late - early) < alike ? fmax(late, early) : INFINITY;
}

/* Whether a run can be made under the tightest tolerance. */
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
is_likely(const qdot_run *run, const qdot_run_request *request)
{
    const double known = (run->report.horizon - run->t0) / (run->t1 - run->t0);

    return known * log(tightest) / log(request->tol) > 1
           || tightest / request->tol * pow(known, -power_of_growth(run)) < few;
}

static qdot_status
say_tighter(qdot_run *run, const qdot_run_request *request, double lost)
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
        || (isnan(lost) ? !isnan((*run)->report.error) : !is_likely(*run, request)))
        return QDOT_OK;
    tighter.tol = tightest;
    status = by->make(scene, &tighter, &other);
    if (status == QDOT_OK && isnan(other->report.horizon) && !isnan(other->report.error)
        && other->report.status != QDOT_RUN_FAILED) {
        by->free(*run);
        *run = other;
        return say_tighter(*run, request, lost);
    }
    by->free(other);
    return qdot_grave(status);
}
