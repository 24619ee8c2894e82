/* longtime.c -- runs a method over a long time, and measures the energy error in growing time windows. */
#include "sim/study/longtime.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "ode/integrate.h"
#include "ode/meter.h"
#include "sim/model/parameter-states.h"
#include "sim/run/long-run.h"
#include "sim/study/method-run.h"

/* The default limit of the work (ns) of a run, and the factor by which it may exceed its prediction. */
static const double budget_default = 1e10, slack = 4;

static const double tolerances[] = {1e-12, 1e-10, 1e-8, 1e-6, 1e-4};

enum { foretelling_steps = 1000, least_in_window = 8, samples_in_window = 256 };

/* A limit of work so large that it is never reached. */
static const uint64_t no_bound = UINT64_MAX / 2;

/* A run whose energy error is sampled. */
typedef struct {
    qdot_method_run *run;
    qdot_longtime_row *row;
    qdot_ode_meter meter;
    double most_work;
    uint64_t steps, next, draw; /* steps so far; next step to be sampled; random state for irregular sampling */
    double square;              /* sum of squared energy errors in the present window */
    size_t count, window;
    bool too_much;
} watched;

/* --- growth of the error ------------------------------------------------------------ */

void
qdot_longtime_fit(size_t n, const double *x, const double *y, double *slope, double *error)
{
    double u = 0, v = 0, uu = 0, uv = 0, squares = 0, products = 0, before = 0, c;

    *slope = *error = NAN;
    for (size_t i = 0; i < n; i++) {
        if (!(y[i] > 0))
            return;
        u += log(x[i]) / (double)n;
        v += log(y[i]) / (double)n;
    }
    if (n < 4)
        return;
    for (size_t i = 0; i < n; i++) {
        uu += (log(x[i]) - u) * (log(x[i]) - u);
        uv += (log(x[i]) - u) * (log(y[i]) - v);
    }
    *slope = uv / uu;
    for (size_t i = 0; i < n; i++) {
        const double r = log(y[i]) - v - *slope * (log(x[i]) - u);

        squares += r * r;
        products += i ? r * before : 0;
        before = r;
    }
    c = squares > 0 ? fmin(0.95, fmax(0, products / squares)) : 0;
    *error = 2 * sqrt(squares / (double)(n - 2) / uu * (1 + c) / (1 - c));
}

/* Fit a power of t to the growth of the energy error, in the later half of the windows, in log t. */
static void
fit_error_growth(qdot_longtime_row *row)
{
    const size_t first = row->n / 2;

    qdot_longtime_fit(row->n - first, row->t + first, row->error + first, &row->growth,
                      &row->growth_error);
}

/* --- the run of one method ---------------------------------------------------------- */

/* The end of time window k, as a fraction of the run's duration; windows grow by a factor of sqrt(2). */
static double
window_end(size_t k)
{
    return pow(2, 0.5 * ((double)k - (QDOT_LONGTIME_WINDOWS - 1)));
}

/* End the time window and store its rms energy error; a window with few steps is dropped. */
static void
close_window(watched *w, double t)
{
    qdot_longtime_row *row = w->row;

    if (w->count >= least_in_window) {
        row->t[row->n] = t;
        row->error[row->n++] = sqrt(w->square / (double)w->count);
        w->square = 0;
        w->count = 0;
    }
}

static qdot_status
sample_energy(double t, const double *y, bool *stop, void *user)
{
    watched *w = user;
    const qdot_method_run *m = w->run;
    const double past = fabs(t - m->t0), whole = fabs(m->t1 - m->t0);

    if (w->meter.work > w->most_work)
        *stop = w->too_much = true;
    if (++w->steps < w->next && t != m->t1)
        return QDOT_OK;
    /* irregular distances avoid that samples always meet the same phase of a periodic motion */
    w->draw = w->draw * 6364136223846793005u + 1442695040888963407u;
    w->next = w->steps + 1 + (w->draw >> 33) % (1 + w->steps / samples_in_window);
    {
        const double e = qdot_method_run_energy_error(w->run, t, y);

        w->square += e * e;
        w->count++;
        w->row->largest = fmax(w->row->largest, fabs(e));
    }
    if (past >= window_end(w->window) * whole || t == m->t1) {
        close_window(w, past);
        while (w->window + 1 < QDOT_LONGTIME_WINDOWS && past >= window_end(w->window) * whole)
            w->window++;
    }
    return QDOT_OK;
}

static qdot_status
count_steps(double t, const double *y, bool *stop, void *user)
{
    uint64_t *left = user;

    (void)t;
    (void)y;
    *stop = --*left == 0;
    return QDOT_OK;
}

static qdot_status
integrate_or_stop(qdot_method_run *m, qdot_ode_options *options, qdot_ode_result *result)
{
    const qdot_ode_system system = qdot_bind_system(m->bind);

    options->carry = m->low;
    options->t1_low = m->t1_low;
    options->max_steps = no_bound;
    memcpy(m->y, m->start, system.n * sizeof *m->y);
    qdot_ode_meter_begin(options->meter, m->t0, m->t1);
    return qdot_ode_integrate(&system, m->plan->method, options, m->t0, m->t1, m->y, result);
}

/* Predict the work of the whole run from its first steps; INFINITY if the steps fail. */
static qdot_status
predict_work(qdot_method_run *m, double tol, double *work)
{
    uint64_t left = foretelling_steps;
    qdot_ode_meter meter = {0};
    qdot_ode_options options = {
        .tol = tol, .accepted = count_steps, .user = &left, .meter = &meter};
    qdot_ode_result result;
    const qdot_status status = integrate_or_stop(m, &options, &result);

    *work = INFINITY;
    if (status == QDOT_EINTR || status == QDOT_ENOMEM)
        return status;
    if (result.t != m->t0)
        *work = meter.work * ((m->t1 - m->t0) / (result.t - m->t0));
    return QDOT_OK;
}

static qdot_status
run_with_samples(qdot_method_run *m, double most_work, qdot_longtime_row *row)
{
    watched w = {.run = m, .row = row, .most_work = most_work};
    qdot_ode_options options = {.tol = row->tol,
                                .accepted = sample_energy,
                                .user = &w,
                                .meter = &w.meter,
                                .stiff_work = most_work};
    qdot_ode_result result;
    qdot_status status;

    qdot_progress_begin(m->t0, m->t1, "%s, tol %.0e", row->method, row->tol);
    status = integrate_or_stop(m, &options, &result);
    if (status == QDOT_EINTR || status == QDOT_ENOMEM)
        return status;
    row->steps = result.stats.steps;
    row->evals = result.stats.evaluations;
    row->cpu = result.stats.cpu;
    if (status != QDOT_OK)
        snprintf(row->status, sizeof row->status, "failed: %.280s", result.reason);
    else if (w.too_much)
        snprintf(row->status, sizeof row->status,
                 "stopped at t = %.6g: more work than its first steps suggested", result.t);
    else
        strcpy(row->status, "done");
    fit_error_growth(row);
    return QDOT_OK;
}

/* --- measuring all methods ---------------------------------------------------------- */

static qdot_status
check_energy_known(const qdot_method_run *m)
{
    if (m->pieces)
        return qdot_fail(QDOT_EFAILED, "an event or a switch may divide the run");
    if (!m->energy) {
        qdot_fail(QDOT_EFAILED, "the energy of this scene is not conserved");
        return qdot_hint("remove friction and forces that depend on time");
    }
    if (m->t0 == m->t1)
        return qdot_fail(QDOT_EINVAL, "the run has no length");
    return QDOT_OK;
}

/* Run a method with one tolerance; *done is false if the first steps predict more work than `most`. */
static qdot_status
run_at_tolerance(qdot_scene *scene, const qdot_run_request *request, double most, qdot_longtime_row *row,
                 bool *done)
{
    qdot_method_run m = {0};
    double work = 0;
    qdot_status status = qdot_method_run_init(&m, scene, request, row->method, row->tol);

    *done = false;
    if (status == QDOT_OK)
        status = qdot_method_run_find_energy(&m, scene);
    if (status == QDOT_OK)
        status = check_energy_known(&m);
    if (status == QDOT_OK)
        status = predict_work(&m, row->tol, &work);
    if (status == QDOT_OK && !(work <= most)) {
        snprintf(row->status, sizeof row->status,
                 "failed: at tol %.0e it would take %.2g times the permitted work", row->tol,
                 work / most);
    } else if (status == QDOT_OK) {
        *done = true;
        status = run_with_samples(&m, isfinite(most) ? slack * most : INFINITY, row);
    }
    qdot_method_run_clear(&m);
    return status;
}

static qdot_status
append_row(qdot_longtime *out, const qdot_longtime_row *row)
{
    QDOT_TRY(qdot_grow(&out->rows, &out->capacity, out->n + 1, sizeof *out->rows));
    out->rows[out->n++] = *row;
    return QDOT_OK;
}

static qdot_status
measure_method(qdot_scene *scene, const qdot_run_request *request, const char *method,
               qdot_longtime *out)
{
    const double most = out->budget > 0 ? out->budget : out->method ? INFINITY : budget_default;
    const size_t rungs = out->tol > 0 ? 1 : sizeof tolerances / sizeof *tolerances;
    qdot_longtime_row row;
    qdot_status status = QDOT_OK;
    bool done = false;

    for (size_t k = 0; k < rungs && !done && status == QDOT_OK; k++) {
        row = (qdot_longtime_row){.method = method,
                                  .tol = out->tol > 0 ? out->tol : tolerances[k],
                                  .growth = NAN,
                                  .growth_error = NAN};
        status = run_at_tolerance(scene, request, most, &row, &done);
    }
    if (status == QDOT_ENOTBUILT && !out->method)
        return qdot_methods_leave_out(&out->left_out, method);
    return status == QDOT_OK ? append_row(out, &row) : status;
}

/* Find the method that `auto` would use, from its plan and, if necessary, from a run. */
static qdot_status
find_automatic_method(qdot_scene *scene, const qdot_run_request *request, qdot_longtime *out)
{
    const double tol = out->tol > 0 ? out->tol : tolerances[0];
    qdot_method_run m = {0};
    qdot_status status = qdot_method_run_init(&m, scene, request, "auto", tol);

    if (status == QDOT_OK)
        status = qdot_method_run_find_energy(&m, scene);
    if (status == QDOT_OK)
        status = check_energy_known(&m);
    if (status == QDOT_OK) {
        const qdot_ode_system system = qdot_bind_system(m.bind);
        const qdot_long_run run = {.plan = m.plan,
                                   .system = &system,
                                   .start = m.start,
                                   .low = m.low,
                                   .t0 = m.t0,
                                   .t1 = m.t1,
                                   .tol = tol};

        status = qdot_long_run_tolerance(&run, &out->chosen_tol);
        out->chosen = m.plan->method;
        out->chosen_long = out->chosen_tol < tol;
    }
    qdot_method_run_clear(&m);
    return status;
}

static qdot_status
measure_all_methods(qdot_scene *scene, const qdot_run_request *request, qdot_longtime *out)
{
    qdot_status status;

    if (out->method)
        return measure_method(scene, request, out->method, out);
    status = find_automatic_method(scene, request, out);
    for (size_t i = 0; status == QDOT_OK && i < qdot_ode_method_count(); i++)
        status = measure_method(scene, request, qdot_ode_method_at(i)->name, out);
    return status;
}

qdot_status
qdot_longtime_measure(qdot_scene *scene, const qdot_run_request *request, qdot_longtime *out)
{
    qdot_parameter_states states = {0};
    qdot_status status;

    QDOT_TRY(qdot_parameter_states_init(&states, scene, request));
    status = measure_all_methods(scene, &states.request, out);
    qdot_parameter_states_clear(&states);
    out->interrupted = status == QDOT_EINTR && out->n > 0;
    return out->interrupted ? QDOT_OK : status;
}

void
qdot_longtime_clear(qdot_longtime *l)
{
    qdot_free(l->rows);
    qdot_free(l->left_out.at);
    *l = (qdot_longtime){0};
}
