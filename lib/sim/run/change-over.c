/* change-over.c -- a stiff run once more by another method, if that is as accurate. */
#include "sim/run/change-over.h"

#include <math.h>

#include "sim/course/run-state.h"

/* Its method for stiff scenes: steps keep its tolerance, but ends are off by a thousand times as
 * much. */
static const char stiff_method[] = "msbdf";
static const double tighter = 1000, tightest = 1e-13;

/* The error, in tolerances, at which a run by series is awaited all the same if it ends within
 * reason. */
static const double rather_wait = 100;

static bool
is_accurate(const qdot_run *run, double tol)
{
    return run->report.scaled_error <= fmax(rather_wait * tol, 1e-10);
}

/* *run's place is taken by `other`, which may be NULL. */
static void
take(const qdot_run_maker *by, qdot_run **run, qdot_run *other)
{
    if (!other)
        return;
    by->free(*run);
    *run = other;
}

static qdot_status
say_changed(qdot_run *run, const char *before, double t)
{
    qdot_text_format(
        qdot_run_next_notice(run),
        "the scene is stiff: from t = %.4g on stability would bound the steps of %s, "
        "so the run is by %s, tol %.3g",
        t, before, run->plan->method->name, run->report.tol);
    return qdot_text_status(&run->notice);
}

static bool
has_arrived(qdot_status status, const qdot_run *run)
{
    return status == QDOT_OK && run->course.tr.result.outcome != QDOT_ODE_FAILED;
}

qdot_status
qdot_run_change_over(qdot_scene *scene, const qdot_run_request *request,
                     const qdot_run_maker *by, qdot_run **run)
{
    const double t = (*run)->course.tr.result.t;
    const char *before = (*run)->plan->method->name;
    qdot_run_request stiff = *request;
    qdot_run *other = NULL, *patient = NULL;
    qdot_status status;

    if (!(*run)->course.tr.result.stiff || !(*run)->plan->chosen)
        return QDOT_OK;
    stiff.method = stiff_method;
    stiff.tol = fmax(request->tol / tighter, tightest);
    status = by->make(scene, &stiff, &other);
    if (status == QDOT_ENOMEM || status == QDOT_EINTR) {
        take(by, run, other);
        return status;
    }
    if (has_arrived(status, other) && is_accurate(other, request->tol)) {
        take(by, run, other);
        return say_changed(*run, before, t);
    }
    stiff = *request;
    stiff.method = before;
    status = by->make(scene, &stiff, &patient);
    if (has_arrived(status, patient) || status == QDOT_EINTR || status == QDOT_ENOMEM) {
        by->free(other);
        take(by, run, patient);
        return status;
    }
    by->free(patient);
    if (!other || other->course.tr.result.outcome == QDOT_ODE_FAILED) {
        by->free(other);
        return QDOT_OK;
    }
    take(by, run, other);
    return say_changed(*run, before, t);
}
