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
    qdot_distance *distance; /* distance of run and companions; NULL: errors are unknown */
} look;

static qdot_status
open_look(qdot_run *run, size_t event, look *l)
{
    l->function = run->stage.events.at[event].function;
    QDOT_TRY(qdot_reader_lower(run->plan, 1, &l->function, &l->of));
    QDOT_TRY(qdot_reader_init(&l->reader, &l->of, &run->course));
    QDOT_TRY(qdot_run_twin(run));
    return qdot_run_comparable(run) ? qdot_distance_new(run, &l->of, &l->distance) : QDOT_OK;
}

static void
close_look(look *l)
{
    qdot_distance_free(l->distance);
    qdot_reader_clear(&l->reader);
    qdot_tape_free(l->of.tape);
}

/* Evaluate the function g of an event at t, and its error; NaN if unknown. */
static qdot_status
touch_look_at(look *l, double t, double *g, double *error)
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
is_doubtful(const qdot_occurrence *o, size_t event)
{
    return o->event == event && o->within > 0;
}

static qdot_status
look_at_all(qdot_run *run, size_t event, look *l, double *widths, double *tol)
{
    for (size_t i = 0; i < run->course.occurrences.n; i++) {
        const qdot_occurrence *o = &run->course.occurrences.at[i];
        double g, error;

        if (!is_doubtful(o, event))
            continue;
        QDOT_TRY(touch_look_at(l, o->t, &g, &error));
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

    while (first < n && !is_doubtful(&run->course.occurrences.at[first], event))
        first++;
    if (first == n)
        return QDOT_OK;
    status = open_look(run, event, &l);
    if (status == QDOT_OK)
        status = look_at_all(run, event, &l, widths, tol);
    close_look(&l);
    return status;
}

/* The slope of g at t is taken from there to this part of the way back to the start of the run. */
static const double near_by = 0x1p-24;

/* How fast g changes just before t; NaN: unknown. */
static qdot_status
look_at_slope(look *l, const qdot_trajectory *tr, double t, double g, double *slope)
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
    qdot_status status = open_look(run, event, &l);

    for (size_t i = 0; i < n && status == QDOT_OK && l.distance; i++) {
        const qdot_occurrence *o = &run->course.occurrences.at[i];
        double g, error, slope;

        if (o->event != event || o->way == 0)
            continue;
        if (i > 0 && o[-1].t == o->t) /* a blow that another one hands on: what meets did not approach before */
            continue;
        status = touch_look_at(&l, o->t, &g, &error);
        if (status == QDOT_OK)
            status = look_at_slope(&l, &run->course.tr, o->t, g, &slope);
        if (status == QDOT_OK && error <= slope * fabs(o->t - run->course.tr.t[0]))
            errors[i] = error / slope;
    }
    close_look(&l);
    return status;
}

/* Whether the event last occurred at the end t of the run. */
static bool
ends_on(const qdot_run *run, size_t event, double t)
{
    if (run->course.stopped_by == event)
        return true;
    for (size_t i = run->course.occurrences.n; i-- > 0;)
        if (run->course.occurrences.at[i].event == event)
            return fabs(run->course.occurrences.at[i].t - t) <= 4 * DBL_EPSILON * fabs(t);
    return false;
}

/* Find the size of g: its largest |value| at eight times of the run. */
static qdot_status
find_size(look *l, const qdot_trajectory *tr, double *size)
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
    if (tr->count < 2 || ends_on(run, event, t))
        return QDOT_OK;
    status = open_look(run, event, &l);
    if (status == QDOT_OK)
        status = touch_look_at(&l, t, &g, &error);
    if (status == QDOT_OK)
        status = find_size(&l, tr, &size);
    if (status == QDOT_OK)
        *undecided = g != 0 && fabs(g) <= 2 * error && fabs(g) <= small * size;
    close_look(&l);
    return status;
}
