/* workprecision.c -- measures error and CPU time of every method at every tolerance. */
#include "sim/study/workprecision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "expr/constant.h"
#include "num/sort.h"
#include "ode/integrate.h"
#include "ode/scale.h"
#include "sim/course/course.h"
#include "sim/course/run-state.h"
#include "sim/error/horizon.h"
#include "sim/form/derived.h"
#include "sim/model/constrained.h"
#include "sim/model/parameter-states.h"
#include "sim/study/method-run.h"

enum { FIRST = 3, LAST = 15, REFERENCE_DIGITS = 20, MOST_TIMES = 9 };

static const double budget_default = 3e8;

/* The tolerance of a reference run in double precision. */
static const double reference_tol = 1e-15;

/* A smaller error counts as rounding, even if the motion varies little. */
static const double rounding = 1e-14;

/* An integration method that is measured, with its run and its limits. */
typedef struct {
    qdot_method_run run;
    qdot_course course; /* the run in pieces, if events or switches may divide it */
    double t_end;
    qdot_ode_system system;
    uint64_t most_evaluations;
    double drift;           /* largest energy drift along the run */
    qdot_constrained *held; /* constraint solver; NULL: no constraints */
    double residual;        /* largest constraint residual so far */
} worker;

/* The end state of the reference run, in double-double precision. */
typedef struct {
    size_t n;
    double *high, *low;
    double t_end;
    bool stopped;     /* an event stopped the reference run, at t_end */
    double variation; /* sensitivity of the end state to the start (horizon.h) */
} reference;

/* --- the reference run --------------------------------------------------------------- */

static qdot_status
make_reference(qdot_scene *scene, const qdot_run_request *request, reference *r,
               double *error)
{
    qdot_run_request precise = *request;
    const qdot_run_report *report;
    qdot_run *run = NULL;
    qdot_status status;
    int side;

    precise.method = "auto";
    precise.digits = REFERENCE_DIGITS;
    precise.tol = reference_tol;
    status = qdot_run_new(scene, &precise, &run);
    if (status == QDOT_ENOTBUILT || (scene->constraints.n > 0 && status == QDOT_ESINGULAR) ||
        /* double precision: `digits` is impossible, as with abs(x)^1.5 or a massless coordinate */
        (run == NULL && status == QDOT_EFAILED)) {
        precise.digits = 0;
        status = qdot_run_new(scene, &precise, &run);
    }
    if (status == QDOT_ENOTBUILT) {
        qdot_error why = *qdot_last_error();

        return qdot_fail(QDOT_ENOTBUILT, "no reference can be made: %.400s", why.message);
    }
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    report = qdot_run_get_report(run);
    if (report->t0 == report->t1) {
        qdot_run_free(run);
        return qdot_fail(QDOT_EINVAL, "the run has no length: nothing can be compared");
    }
    *error = report->error;
    r->n = 2 * report->n;
    r->variation = qdot_horizon_variation(&run->course.tr);
    r->high = qdot_calloc(2 * r->n, sizeof *r->high);
    if (!r->high)
        status = QDOT_ENOMEM;
    else
        r->low = r->high + r->n;
    r->t_end = report->t1;
    r->stopped = report->status == QDOT_RUN_STOPPED;
    if (status == QDOT_OK && report->status == QDOT_RUN_FAILED)
        status = qdot_fail(QDOT_EFAILED, "the reference did not reach the end: %.300s",
                           report->reason);
    if (status == QDOT_OK && isnan(report->error))
        status = qdot_fail(QDOT_EFAILED, "the error of the reference is unknown");
    for (size_t i = 0; i < r->n && status == QDOT_OK; i++) {
        if (report->exact)
            status = qdot_constant_split(scene->pool, report->exact[i], &r->high[i],
                                         &side, &r->low[i]);
        else
            r->high[i] = i < report->n ? report->q[i] : report->v[i - report->n];
    }
    qdot_run_free(run);
    return status;
}

/* Find the scaled error of an end state; if an event ends the run, also the error of the event's time. */
static double
error_against(const reference *r, const double *scales, const double *y, double t)
{
    double most = r->stopped ? fabs(t - r->t_end) / fmax(1, fabs(r->t_end)) : 0;

    for (size_t i = 0; i < r->n; i++) {
        double e = fabs((y[i] - r->high[i]) - r->low[i]) / qdot_ode_size(scales, i, r->high[i]);

        if (!(e <= most)) /* also true for a NaN, which then stays */
            most = e;
    }
    return most;
}

/* --- the runs of one method ---------------------------------------------------------- */

static void
record_energy_drift(worker *w, double t, const double *y)
{
    const double change = fabs(qdot_method_run_energy_error(&w->run, t, y));

    if (!(change <= w->drift))
        w->drift = change;
}

static void
record_constraint_residual(worker *w, double t, const double *y)
{
    qdot_constrained_residual r = qdot_constrained_measure(w->held, t, y);
    double residual = r.worst_position == SIZE_MAX ? r.velocity : r.position;

    if (!(residual <= w->residual))
        w->residual = residual;
}

static qdot_status
record_drifts_of_step(double t, const double *y, bool *stop, void *user)
{
    worker *w = user;

    (void)stop;
    if (w->run.energy)
        record_energy_drift(w, t, y);
    if (w->held)
        record_constraint_residual(w, t, y);
    return QDOT_OK;
}

static void
clear_worker(worker *w)
{
    qdot_course_clear(&w->course);
    qdot_method_run_clear(&w->run);
}

static qdot_status
begin_worker(worker *w, qdot_scene *scene, const qdot_run_request *request,
             const char *method, double tol, double budget)
{
    double n, operations;

    QDOT_TRY(qdot_method_run_init(&w->run, scene, request, method, tol));
    QDOT_TRY(qdot_method_run_find_energy(&w->run, scene));
    w->held = w->run.held;
    w->system = qdot_bind_system(w->run.bind);
    n = (double)(w->run.plan->n + w->run.plan->m);
    operations = (double)qdot_plan_operations(w->run.plan, NULL) + n * n * n / 3 + 100;
    if (w->run.plan->method->series) /* one expansion costs a few hundred evaluations of f */
        operations *= 200;
    w->most_evaluations = (uint64_t)fmax(100, budget / operations);
    return QDOT_OK;
}

/* Whether the energy is conserved along the whole run: no event changes it. */
static bool
is_energy_kept(const worker *w)
{
    for (size_t i = 0; i < w->run.stage.events.n; i++)
        if (w->run.stage.events.at[i].then)
            return false;
    return w->run.energy != NULL;
}

/* Measure the drifts of the energy and of the constraints at all stored points of the run. */
static void
measure_drifts(worker *w)
{
    const qdot_trajectory *tr = &w->course.tr;

    w->drift = w->residual = 0;
    for (size_t k = 0; k < tr->count; k++) {
        const double *y = tr->y + k * tr->n;
        const qdot_trajectory_piece *p = tr->pieces.at + qdot_trajectory_piece_of(tr, k);

        if (is_energy_kept(w))
            record_energy_drift(w, tr->t[k], y);
        if (w->held) {
            w->held = qdot_bind_held(w->course.binds.at[p->mode]);
            record_constraint_residual(w, tr->t[k], y);
        }
    }
}

/* Integrate a run that events, domains or switches may divide into pieces. */
static qdot_status
integrate_in_pieces(worker *w, double tol, bool watched, qdot_ode_result *result)
{
    const uint64_t a_step = w->run.plan->method->series ? 1 : 10; /* evaluations of f in one step, approximately */
    const qdot_ode_options options = {.tol = tol,
                                      .carry = w->run.low,
                                      .t1_low = w->run.t1_low,
                                      .max_steps = w->most_evaluations / a_step + 1};
    const qdot_trajectory *tr = &w->course.tr;
    qdot_status status;

    qdot_course_clear(&w->course);
    w->course.stage = &w->run.stage;
    w->course.touch_tol = tol;
    w->course.most_looked = w->most_evaluations;
    status = qdot_course_run(&w->course, w->run.plan->method, &options, w->run.t0, w->run.t1,
                             w->run.start);
    *result = tr->result;
    if (tr->count == 0)
        return status == QDOT_OK ? qdot_fail(QDOT_EFAILED, "nothing was integrated") : status;
    memcpy(w->run.y, tr->y + (tr->count - 1) * tr->n, tr->n * sizeof *w->run.y);
    w->t_end = tr->t[tr->count - 1];
    if (status == QDOT_OK && w->course.failed)
        return qdot_fail(QDOT_EFAILED, "%s", w->course.reason);
    if (watched && status == QDOT_OK)
        measure_drifts(w);
    return status;
}

/* Integrate from start to end; `watched`: measure drifts; otherwise only the time is measured. */
static qdot_status
integrate_once(worker *w, double tol, bool watched, qdot_ode_result *result)
{
    qdot_ode_options options = {.tol = tol,
                                .max_evaluations = w->most_evaluations,
                                .carry = w->run.low,
                                .t1_low = w->run.t1_low};

    qdot_progress_begin(w->run.t0, w->run.t1, "%s, tol %.0e", w->run.plan->method->name, tol);
    if (w->run.pieces)
        return integrate_in_pieces(w, tol, watched, result);
    memcpy(w->run.y, w->run.start, w->system.n * sizeof *w->run.y);
    w->t_end = w->run.t1;
    if (watched && (w->run.energy || w->held)) {
        w->drift = w->residual = 0;
        options.accepted = record_drifts_of_step;
        options.user = w;
    }
    /* only methods that can count their work in advance */
    if (w->run.plan->method->series || w->run.plan->method->geometric)
        options.max_steps = w->most_evaluations;
    return qdot_ode_integrate(&w->system, w->run.plan->method, &options,
                              w->run.t0, w->run.t1, w->run.y, result);
}

/* Measure the CPU time by at least three runs; by more if they are short. */
static qdot_status
measure_times(worker *w, double tol, double first, qdot_workprecision_row *row)
{
    double times[MOST_TIMES];
    int n = first < 0.02 ? MOST_TIMES : first < 0.1 ? 5 : 3;

    for (int i = 0; i < n; i++) {
        qdot_ode_result result;

        QDOT_TRY(integrate_once(w, tol, false, &result));
        times[i] = result.stats.cpu;
    }
    qdot_sort((size_t)n, times);
    row->time_min = times[0];
    row->time_median = times[n / 2];
    return QDOT_OK;
}

static bool
is_failure_reported(qdot_status status)
{
    return status == QDOT_EFAILED || status == QDOT_ELIMIT || status == QDOT_EDOMAIN
           || status == QDOT_ESINGULAR || status == QDOT_EINVAL;
}

static qdot_status
measure_at_tolerance(worker *w, double tol, const reference *r, qdot_workprecision_row *row)
{
    qdot_ode_result result;
    qdot_status status = integrate_once(w, tol, true, &result);

    *row = (qdot_workprecision_row){.method = w->run.plan->method->name,
                                    .tol = tol,
                                    .err = NAN,
                                    .scd = NAN,
                                    .time_min = NAN,
                                    .time_median = NAN,
                                    .evals = result.stats.evaluations,
                                    .steps = result.stats.steps,
                                    .rejected = result.stats.rejected,
                                    .energy_err = NAN,
                                    .constraint_err = NAN};
    if (is_failure_reported(status)) {
        snprintf(row->status, sizeof row->status, "failed: %.290s",
                 qdot_last_error()->message);
        return QDOT_OK;
    }
    QDOT_TRY(status);
    if (r->stopped != (w->run.pieces && w->course.stopped_by != SIZE_MAX)) {
        strcpy(row->status, r->stopped ? "failed: the event that ends the run was not met"
                                       : "failed: an event ended the run");
        return QDOT_OK;
    }
    row->err = error_against(r, w->run.stage.scales, w->run.y, w->t_end);
    strcpy(row->status, row->err > rounding
                                && row->err >= QDOT_HORIZON_NONE_LEFT * r->variation
                            ? "done: no digit is right"
                            : "done");
    row->scd = -log10(fmax(row->err, 0x1p-60));
    if (is_energy_kept(w))
        row->energy_err = w->drift;
    if (w->held)
        row->constraint_err = w->residual;
    return measure_times(w, tol, result.stats.cpu, row);
}

static qdot_status
append_row(qdot_workprecision *out, const qdot_workprecision_row *row)
{
    QDOT_TRY(qdot_grow(&out->rows, &out->capacity, out->n + 1, sizeof *out->rows));
    out->rows[out->n++] = *row;
    return QDOT_OK;
}

static double
tolerance_of_row(int k)
{
    return strtod((char[]){'1', 'e', '-', (char)('0' + k / 10), (char)('0' + k % 10), 0}, NULL);
}

/* Whether the plan must be made anew for each tolerance, as some forms of equations depend on it
 * (sim/form/eliminated.h). */
static bool
needs_new_plan(const worker *w)
{
    return w->run.plan->constraints && w->run.plan->method->series;
}

/* Measure an integration method at all tolerances. */
static qdot_status
measure_method(qdot_scene *scene, const qdot_run_request *request, const char *method,
               const reference *r, qdot_workprecision *out)
{
    const double budget = out->budget > 0 ? out->budget : budget_default;
    worker w = {0};
    qdot_status status = begin_worker(&w, scene, request, method, tolerance_of_row(FIRST), budget);

    for (int k = FIRST; k <= LAST && status == QDOT_OK; k++) {
        qdot_workprecision_row row;

        if (k > FIRST && needs_new_plan(&w)) {
            clear_worker(&w);
            w = (worker){0};
            status = begin_worker(&w, scene, request, method, tolerance_of_row(k), budget);
        }
        if (status == QDOT_OK)
            status = measure_at_tolerance(&w, tolerance_of_row(k), r, &row);
        if (status == QDOT_OK)
            status = append_row(out, &row);
    }
    clear_worker(&w);
    return status;
}

static qdot_status
measure_all_methods(qdot_scene *scene, const qdot_run_request *request, qdot_workprecision *out)
{
    reference r = {0};
    qdot_status status = make_reference(scene, request, &r, &out->ref_err);

    out->constraints = scene->constraints.n > 0;
    for (size_t i = 0; status == QDOT_OK && i < qdot_ode_method_count(); i++) {
        const char *method = qdot_ode_method_at(i)->name;

        status = measure_method(scene, request, method, &r, out);
        if (status == QDOT_ENOTBUILT)
            status = qdot_methods_leave_out(&out->left_out, method);
    }
    out->interrupted = status == QDOT_EINTR && out->n > 0;
    if (out->interrupted)
        status = QDOT_OK;
    qdot_free(r.high);
    return status;
}

qdot_status
qdot_workprecision_measure(qdot_scene *scene, const qdot_run_request *request,
                           qdot_workprecision *out)
{
    qdot_parameter_states states = {0};
    qdot_status status;

    QDOT_TRY(qdot_parameter_states_init(&states, scene, request));
    status = measure_all_methods(scene, &states.request, out);
    qdot_parameter_states_clear(&states);
    return status;
}

void
qdot_workprecision_clear(qdot_workprecision *w)
{
    qdot_free(w->rows);
    qdot_free(w->left_out.at);
    *w = (qdot_workprecision){0};
}
