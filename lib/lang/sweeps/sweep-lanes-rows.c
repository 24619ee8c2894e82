/* sweep-lanes-rows.c -- fills the rows of those runs of a sweep that were made together in vector lanes: columns with
 * errors. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "lang/session/bind.h"
#include "lang/session/trial.h"
#include "lang/sweeps/sweep-lanes-parts.h"
#include "num/sort.h"
#include "ode/companion.h"
#include "sim/ensemble/path.h"
#include "tape/rounding.h"

/* A run (member) of a sweep with a larger error is repeated as a single run, which may use a better method. */
static const double largest_error = 1e-4;
enum { PLACES = 16 };

/* A distance of so many roundings a step, which add up as a random walk, may be of rounding; one that is
 * far less at the end than before may be so by chance. Then one companion does not tell enough. */
static const double roundings = 64;

/* The error between steps counts as at most this many times the error at the end (ode/companion.h). */
static const double most_between = 30;

/* coordinates of a size between `nothing` and `small` may need a scale of their own (sim/run/scales.h) */
static const double small = 1e-3, nothing = 1e-15;

/* Evaluate all expressions of that pass of a member at a stored time, into out [outputs]; false:
 * there is no state. */
static bool
evaluate_member_at(qdot_sweep_lanes *x, size_t pass, size_t m, size_t place, double t, double *out)
{
    if (!qdot_ensemble_state(x->ensemble, pass, m, place, x->in))
        return false;
    x->in[2 * qdot_ensemble_plan(x->ensemble)->n] = t;
    qdot_tape_eval(x->tape, x->in, out, x->work);
    return true;
}

/* Find the errors [outputs] of all expressions at a stored time; their values are put into x->out. */
static bool
find_errors_at_time(qdot_sweep_lanes *x, size_t m, size_t place, double *errors)
{
    const size_t n = x->outputs;

    for (size_t pass = x->companions + 1; pass-- > 0;) /* the run itself after its companions: its inputs remain */
        if (!evaluate_member_at(x, pass, m, place, qdot_ensemble_time(x->ensemble, place), x->out + pass * n))
            return false;
    for (size_t i = 0; i < x->outputs; i++) {
        const double theirs[] = {x->out[n + i], x->out[2 * n + i]};

        errors[i] = qdot_ensemble_error_of(x->out[i], x->companions, theirs);
    }
    return true;
}

/* Whether an error may be due to rounding only, which needs two companion runs to be estimated. */
static bool
may_be_rounding_error(const qdot_sweep_lanes *x, size_t m, double error, double size)
{
    return x->companions == 1
           && error <= roundings * DBL_EPSILON * sqrt((double)(x->results[m].steps + 1))
                           * fmax(1, size);
}

static bool
is_accurate(double value, double error)
{
    return isfinite(value) && isfinite(error)
           && error <= largest_error * fmax(1, fabs(value));
}

/* Evaluate the expressions for run (member) m at its end: values and errors [outputs]. */
static qdot_status
evaluate_at_end(qdot_sweep_lanes *x, size_t m, double *values, double *errors, bool *there)
{
    const size_t n = x->outputs;
    double *between = qdot_calloc((x->places + 1) * n + 1, sizeof *between);
    double *const bounds = between + x->places * n;
    double sorted[PLACES];

    if (between == NULL)
        return QDOT_ENOMEM;
    *there = x->places <= PLACES;
    for (size_t k = 0; k < x->places && *there; k++)
        *there = find_errors_at_time(x, m, k, between + k * n);
    *there = *there && find_errors_at_time(x, m, x->places, errors);
    if (*there)
        qdot_rounding_bounds(x->tape, x->in, NULL, bounds, x->work);
    for (size_t i = 0; i < n && *there; i++) {
        const double size = bounds[i] / DBL_EPSILON;

        for (size_t k = 0; k < x->places; k++)
            sorted[k] = between[k * n + i];
        qdot_sort(x->places, sorted);
        values[i] = x->out[i];
        x->unsure = x->unsure || may_be_rounding_error(x, m, errors[i], size)
                    || (x->companions == 1 && sorted[x->places / 2] > most_between * errors[i]);
        errors[i] = fmax(errors[i], fmin(sorted[x->places / 2], most_between * errors[i]));
        errors[i] += bounds[i];
        *there = is_accurate(values[i], errors[i]);
    }
    qdot_free(between);
    return QDOT_OK;
}

/* Whether the coordinates of run m are so small that, made as a single run, it would determine scales. */
static bool
has_small_coordinates(const qdot_sweep_lanes *x, size_t m)
{
    const double *sizes = qdot_ensemble_sizes(x->ensemble, m);

    for (size_t i = 0; i < x->n; i++)
        if (sizes[i] > nothing && sizes[i] < small)
            return true;
    return false;
}

/* Find the time of an event and its error; *there false: the run must be repeated as a single run. */
static qdot_status
find_event_time(qdot_sweep_lanes *x, size_t m, const qdot_sweep_lanes_column *of, size_t k, double *to, bool *there)
{
    double t[QDOT_ENSEMBLE_PASSES], *error = x->s->table->errors + (to - x->s->table->values);
    qdot_text text = {0};

    for (size_t pass = 0; pass <= x->companions; pass++)
        t[pass] = qdot_ensemble_event_time(x->ensemble, pass, m, of->event, of->k);
    if (!isnan(t[0])) {
        *to = t[0];
        *error = qdot_ensemble_error_of(t[0], x->companions, t + 1);
        x->unsure = x->unsure || may_be_rounding_error(x, m, *error, fabs(t[0]));
        *error += DBL_EPSILON * fabs(t[0]);
        *there = isfinite(*error); /* a time of unknown error is not given; the run is then repeated as a single run */
        return QDOT_OK;
    }
    if (x->reasons[k] != NULL)
        return QDOT_OK;
    qdot_text_format(&text, "%s[%zu]: the event occurred %zu time%s in the run",
                     x->names.at[of->event], of->k + 1,
                     qdot_ensemble_event_count(x->ensemble, m, of->event),
                     qdot_ensemble_event_count(x->ensemble, m, of->event) == 1 ? "" : "s");
    x->reasons[k] = text.at;
    return qdot_text_status(&text);
}

/* Evaluate columns that read intermediate times, with the member as the latest run. A failure is
 * left to a single run to report. */
static qdot_status
evaluate_course_columns(qdot_sweep_lanes *x, qdot_expr end, double *values, double *errors, bool *there)
{
    qdot_cursor own = *x->s->c;

    for (size_t i = 0; i < x->s->columns.at.n && *there; i++) {
        qdot_status status;

        if (x->columns[i].kind != QDOT_LANES_WAY)
            continue;
        status = qdot_columns_measure(&own, &x->s->columns, i, end, values + i, errors + i);
        if (status == QDOT_ENOMEM || status == QDOT_EINTR)
            return status;
        *there = status == QDOT_OK && is_accurate(values[i], errors[i]);
    }
    return QDOT_OK;
}

/* As evaluate_course_columns, for row k of the sweep, whose parameter values are set; finds values and errors [columns]. */
static qdot_status
evaluate_course_of_row(qdot_sweep_lanes *x, size_t m, size_t k, double *values, double *errors, bool *there)
{
    qdot_trial trial;
    qdot_request request = {0};
    qdot_status status;

    QDOT_TRY(qdot_ensemble_path_take(x->ensemble, m, x->run, there));
    QDOT_TRY(qdot_trial_begin(&trial, x->s->c->session));
    status = qdot_sweep_lanes_request(x->s, k, x->s->table->values + k * x->s->table->n, &request);
    if (status == QDOT_OK && *there)
        status = qdot_trial_lend(&trial, &request.request, x->run);
    if (status == QDOT_OK && *there)
        status = evaluate_course_columns(x, request.request.t1, values, errors, there);
    qdot_trial_end(&trial);
    qdot_request_free(&request);
    return status;
}

qdot_status
qdot_sweep_lanes_fill_row(qdot_sweep_lanes *x, size_t m, size_t k)
{
    const qdot_ensemble_result *result = x->results + m;
    qdot_row_table *t = x->s->table;
    double *values = t->values + k * t->n, *errors = t->errors + k * t->n;
    double *of = qdot_calloc(2 * x->outputs + 1, sizeof *of);
    bool there = !qdot_ensemble_left(x->ensemble, m) && !has_small_coordinates(x, m);
    qdot_status status = of ? QDOT_OK : QDOT_ENOMEM;

    if (x->outputs + x->ways > 0)
        there = there && result->error <= largest_error;
    if (status == QDOT_OK && there && x->outputs > 0)
        status = evaluate_at_end(x, m, of, of + x->outputs, &there);
    if (status == QDOT_OK && there && x->ways > 0)
        status = evaluate_course_of_row(x, m, k, values + t->n_swept, errors + t->n_swept, &there);
    for (size_t i = 0; i < t->n - t->n_swept && status == QDOT_OK && there; i++) {
        const qdot_sweep_lanes_column *c = x->columns + i;

        if (c->kind == QDOT_LANES_EVENT) {
            status = find_event_time(x, m, c, k, values + t->n_swept + i, &there);
        } else if (c->kind == QDOT_LANES_AT_END) {
            values[t->n_swept + i] = of[c->output];
            errors[t->n_swept + i] = of[x->outputs + c->output];
        }
    }
    qdot_free(of);
    for (size_t i = 0; i < t->n_swept; i++)
        errors[i] = 0;
    for (size_t i = t->n_swept; i < t->n && status == QDOT_OK && !there; i++)
        values[i] = errors[i] = NAN;
    if (!there) {
        qdot_free(x->reasons[k]);
        x->reasons[k] = NULL;
    }
    x->made[k] = there;
    return status;
}
