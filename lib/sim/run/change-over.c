/* change-over.c -- repeats a stiff run with an implicit method; keeps that run if it is as accurate. */
#include "sim/run/change-over.h"

#include <math.h>

#include "sim/course/run-state.h"

/* The method for stiff scenes, and the tolerance below which rounding dominates that method's errors. */
static const char stiff_method[] = "radau";
static const double tightest = 1e-13;

/* The error, in tolerances, at which a run by series is awaited all the same if it ends within
 * reason. */
static const double rather_wait = 100;

static bool
is_as_accurate_as(const qdot_run *run, double tol)
{
    return run->report.scaled_error <= fmax(rather_wait * tol, 1e-10);
}

/* Replace *run by `other`, unless that is NULL. */
static void
replace_run(const qdot_run_maker *by, qdot_run **run, qdot_run *other)
{
    if (!other)
        return;
    by->free(*run);
    *run = other;
}

/* The most changes of the method that are listed individually. */
enum { most_told = 4 };

static qdot_status
add_notice_of_change(qdot_run *run, const char *before, double t)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_text *notice = qdot_run_next_notice(run);

    qdot_text_format(
        notice,
        "the scene is stiff: from t = %.4g on stability would bound the steps of %s, "
        "so the run is by %s",
        t, before, run->plan->method->name);
    for (size_t i = 0; i < tr->turns.n && i < most_told; i++)
        qdot_text_format(notice, ", from t = %.4g on by %s", tr->t[tr->turns.at[i].first],
                         tr->turns.at[i].method->name);
    if (tr->turns.n > most_told)
        qdot_text_format(notice, ", and so on, %zu changes in all", tr->turns.n);
    return qdot_text_status(notice);
}

static bool
has_reached_end(qdot_status status, const qdot_run *run)
{
    return status == QDOT_OK && run->course.tr.result.outcome != QDOT_ODE_FAILED;
}

/* Make the run by the stiff method, with series where they are faster; without these where nothing
 * is known of the error then, since the companions did not change with it. */
static qdot_status
make_stiff_run(qdot_scene *scene, const qdot_run_request *request, const qdot_run_maker *by,
               qdot_run **out)
{
    qdot_run_request stiff = *request;
    qdot_run *turning;

    stiff.method = stiff_method;
    stiff.tol = fmax(request->tol, tightest);
    stiff.turns = true;
    QDOT_TRY(by->make(scene, &stiff, out));
    if ((*out)->course.tr.turns.n == 0 || !isnan((*out)->report.scaled_error)
        || !has_reached_end(QDOT_OK, *out))
        return QDOT_OK;
    turning = *out;
    stiff.turns = false;
    *out = NULL;
    by->free(turning);
    return by->make(scene, &stiff, out);
}

qdot_status
qdot_run_change_over(qdot_scene *scene, const qdot_run_request *request,
                     const qdot_run_maker *by, qdot_run **run)
{
    const double t = (*run)->course.tr.result.t;
    const char *before = (*run)->plan->method->name;
    qdot_run_request series = *request;
    qdot_run *other = NULL, *patient = NULL;
    qdot_status status;

    if (!(*run)->course.tr.result.stiff || !(*run)->plan->chosen)
        return QDOT_OK;
    status = make_stiff_run(scene, request, by, &other);
    if (status == QDOT_ENOMEM || status == QDOT_EINTR) {
        replace_run(by, run, other);
        return status;
    }
    if (has_reached_end(status, other) && is_as_accurate_as(other, request->tol)) {
        replace_run(by, run, other);
        return add_notice_of_change(*run, before, t);
    }
    series.method = before;
    status = by->make(scene, &series, &patient);
    if (has_reached_end(status, patient) || status == QDOT_EINTR || status == QDOT_ENOMEM) {
        by->free(other);
        replace_run(by, run, patient);
        return status;
    }
    by->free(patient);
    if (!other || other->course.tr.result.outcome == QDOT_ODE_FAILED) {
        by->free(other);
        return QDOT_OK;
    }
    replace_run(by, run, other);
    return add_notice_of_change(*run, before, t);
}
