/* touches.c -- evaluates an event's function, with its error, at times at which it touches 0. */
#include "sim/error/touches.h"

#include <float.h>
#include <math.h>

#include "sim/course/reader.h"
#include "sim/error/companion.h"
#include "sim/error/distance.h"

typedef struct {
    qdot_expr function;
    qdot_reading of;
    qdot_reader reader;
    qdot_distance *distance; /* distance of the run from its companion runs; NULL: errors are unknown */
} look;

static qdot_status
begin_evaluation(qdot_run *run, size_t event, look *l)
{
    l->function = run->stage.events.at[event].function;
    QDOT_TRY(qdot_reader_lower(run->plan, 1, &l->function, &l->of));
    QDOT_TRY(qdot_reader_init(&l->reader, &l->of, &run->course));
    QDOT_TRY(qdot_run_twin(run));
    return qdot_run_comparable(run) ? qdot_distance_new(run, &l->of, &l->distance) : QDOT_OK;
}

static void
clear_evaluation(look *l)
{
    qdot_distance_free(l->distance);
    qdot_reader_clear(&l->reader);
    qdot_tape_free(l->of.tape);
}

/* Evaluate the event's function g at time t, and its error; NaN if unknown. */
static qdot_status
evaluate_with_error(look *l, double t, double *g, double *error)
{
    qdot_status status = qdot_reader_at(&l->reader, SIZE_MAX, t, g);

    *error = NAN;
    if (status == QDOT_OK && l->distance)
        status = qdot_distance_at(l->distance, t, g, error);
    if (!qdot_reader_has_nothing(status))
        return status;
    *g = *error = NAN;
    return QDOT_OK;
}

static bool
is_touching_occurrence(const qdot_occurrence *o, size_t event)
{
    return o->event == event && o->within > 0;
}

static qdot_status
examine_touches(qdot_run *run, size_t event, look *l, double *widths, double *tol)
{
    for (size_t i = 0; i < run->course.occurrences.n; i++) {
        const qdot_occurrence *o = &run->course.occurrences.at[i];
        double g, error;

        if (!is_touching_occurrence(o, event))
            continue;
        QDOT_TRY(evaluate_with_error(l, o->t, &g, &error));
        if (widths)
            widths[i] = sqrt(2 * (fabs(g) + error) / fabs(o->bend));
        if (tol && fabs(g) > 2 * error)
            *tol = fmin(*tol, 0.5 * o->within);
    }
    return QDOT_OK;
}

qdot_status
qdot_touches_look(qdot_run *run, size_t event, double *widths, double *tol)
{
    const size_t n = run->course.occurrences.n;
    look l = {0};
    qdot_status status;
    size_t first = 0;

    while (first < n && !is_touching_occurrence(&run->course.occurrences.at[first], event))
        first++;
    if (first == n)
        return QDOT_OK;
    status = begin_evaluation(run, event, &l);
    if (status == QDOT_OK)
        status = examine_touches(run, event, &l, widths, tol);
    clear_evaluation(&l);
    return status;
}

/* The slope of g at t is taken between t and this fraction of the time back to the start of the run. */
static const double near_by = 0x1p-24;

/* Find how fast the event's function g changes just before t, |dg/dt|; NaN: unknown. */
static qdot_status
find_slope_before(look *l, const qdot_trajectory *tr, double t, double g, double *slope)
{
    const double by = near_by * (tr->t[0] - t);
    double before;
    const qdot_status status = qdot_reader_at(&l->reader, SIZE_MAX, t + by, &before);

    *slope = status == QDOT_OK && by != 0 ? fabs((g - before) / by) : NAN;
    return qdot_reader_has_nothing(status) ? QDOT_OK : status;
}

qdot_status
qdot_touches_crossings(qdot_run *run, size_t event, double *errors)
{
    const size_t n = run->course.occurrences.n;
    look l = {0};
    qdot_status status = begin_evaluation(run, event, &l);

    for (size_t i = 0; i < n && status == QDOT_OK && l.distance; i++) {
        const qdot_occurrence *o = &run->course.occurrences.at[i];
        double g, error, slope;

        if (o->event != event || o->way == 0)
            continue;
        if (i > 0 && o[-1].t == o->t) /* a blow that another one hands on: what meets did not approach before */
            continue;
        status = evaluate_with_error(&l, o->t, &g, &error);
        if (status == QDOT_OK)
            status = find_slope_before(&l, &run->course.tr, o->t, g, &slope);
        if (status == QDOT_OK && error <= slope * fabs(o->t - run->course.tr.t[0]))
            errors[i] = error / slope;
    }
    clear_evaluation(&l);
    return status;
}

/* Whether the event last occurred at the end t of the run. */
static bool
ends_at_event(const qdot_run *run, size_t event, double t)
{
    if (run->course.stopped_by == event)
        return true;
    for (size_t i = run->course.occurrences.n; i-- > 0;)
        if (run->course.occurrences.at[i].event == event)
            return fabs(run->course.occurrences.at[i].t - t) <= 4 * DBL_EPSILON * fabs(t);
    return false;
}

/* Find the size of the event's function g: its largest magnitude at eight times of the run. */
static qdot_status
find_function_size(look *l, const qdot_trajectory *tr, double *size)
{
    enum { PLACES = 8 };
    const double t0 = tr->t[0], t1 = tr->t[tr->count - 1];

    *size = 0;
    for (int k = 0; k < PLACES; k++) {
        double g;
        const qdot_status status =
            qdot_reader_at(&l->reader, SIZE_MAX, t0 + (t1 - t0) * ((k + 0.5) / PLACES), &g);

        if (status == QDOT_OK)
            *size = fmax(*size, fabs(g));
        else if (!qdot_reader_has_nothing(status))
            return status;
    }
    return QDOT_OK;
}

qdot_status
qdot_touches_end(qdot_run *run, size_t event, bool *undecided)
{
    static const double small = 1e-3; /* near a jump the error is as large as g itself */
    const qdot_trajectory *tr = &run->course.tr;
    const double t = tr->t[tr->count - 1];
    look l = {0};
    double g, error, size;
    qdot_status status = QDOT_OK;

    *undecided = false;
    if (tr->count < 2 || ends_at_event(run, event, t))
        return QDOT_OK;
    status = begin_evaluation(run, event, &l);
    if (status == QDOT_OK)
        status = evaluate_with_error(&l, t, &g, &error);
    if (status == QDOT_OK)
        status = find_function_size(&l, tr, &size);
    if (status == QDOT_OK)
        *undecided = g != 0 && fabs(g) <= 2 * error && fabs(g) <= small * size;
    clear_evaluation(&l);
    return status;
}
