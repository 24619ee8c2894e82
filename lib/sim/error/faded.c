/* faded.c -- finds the time from which an event's function cannot be told from 0 within its error. */
#include "sim/error/faded.h"

#include <math.h>

#include "sim/course/reader.h"
#include "sim/error/companion.h"
#include "sim/error/distance.h"

typedef struct {
    qdot_expr function;
    qdot_reading of;
    qdot_reader reader;
    qdot_distance *distance;
    size_t n;  /* number of occurrences of the event */
    double *t; /* [n + 2] start of the run, times of the occurrences, end of the search */
    double *errors; /* [n + 2] errors of the times; NaN: the event does not occur in the companion runs */
    double size;      /* largest |g| seen along the run, g being the event's function */
    double tol, end;  /* tolerance and end time of the run */
} look;

static void
clear_look(look *l)
{
    qdot_distance_free(l->distance);
    qdot_reader_clear(&l->reader);
    qdot_tape_free(l->of.tape);
    qdot_free(l->t);
    qdot_free(l->errors);
}

/* Prepare to evaluate an event's function with its error up to the time `end`. */
static qdot_status
prepare_evaluation(qdot_run *run, size_t event, double end, look *l)
{
    const qdot_course *c = &run->course;

    l->t = qdot_calloc(c->occurrences.n + 2, sizeof *l->t);
    l->errors = qdot_calloc(c->occurrences.n + 2, sizeof *l->errors);
    if (!l->t || !l->errors)
        return QDOT_ENOMEM;
    l->t[0] = c->tr.t[0];
    for (size_t i = 0; i < c->occurrences.n; i++)
        if (c->occurrences.at[i].event == event) {
            l->t[++l->n] = c->occurrences.at[i].t;
            l->errors[l->n] = run->occurrences.at[i].error;
        }
    l->tol = run->report.tol;
    l->t[l->n + 1] = end;
    l->end = c->tr.t[c->tr.count - 1];
    l->function = run->stage.events.at[event].function;
    QDOT_TRY(qdot_reader_lower(run->plan, 1, &l->function, &l->of));
    QDOT_TRY(qdot_reader_init(&l->reader, &l->of, c));
    return qdot_distance_new(run, &l->of, &l->distance);
}

/* Whether g(t) differs from 0 by more than its error and by more than `least`; true also if the
 * error is unknown. */
static qdot_status
differs_from_zero(look *l, double t, double least, bool *seen)
{
    double g, error = NAN;
    qdot_status status = qdot_reader_at(&l->reader, SIZE_MAX, t, &g);

    if (status == QDOT_OK)
        status = qdot_distance_at(l->distance, t, &g, &error);
    *seen = status != QDOT_OK || !(fabs(g) <= fmax(2 * error, least)) || g == 0;
    return qdot_reader_has_nothing(status) ? QDOT_OK : status;
}

/* Find l->size, the largest |g| of the event's function at some times along the run. */
static qdot_status
find_function_size(look *l)
{
    enum { PLACES = 64 };

    for (int k = 0; k <= PLACES; k++) {
        double g;
        const qdot_status status =
            qdot_reader_at(&l->reader, SIZE_MAX, l->t[0] + (l->t[l->n + 1] - l->t[0]) * k / PLACES, &g);

        if (status == QDOT_OK)
            l->size = fmax(l->size, fabs(g));
        else if (!qdot_reader_has_nothing(status))
            return status;
    }
    return QDOT_OK;
}

/* Whether the error of occurrence k is at most that part of the time to its neighbours: run and companions agree about it.
 * They do about the start and the end of the run. */
static bool
is_time_certain(const look *l, size_t k, double part)
{
    const double before = k > 0 ? fabs(l->t[k] - l->t[k - 1]) : INFINITY,
                 behind = k < l->n ? fabs(l->t[k + 1] - l->t[k]) : before;

    return l->errors[k] <= part * fmin(before, behind);
}

/* The least |g| that counts as seen between occurrences k - 1 and k, even if companions say that its error is less: where
 * they do not agree about these, that within the tolerance. */
static double
least_visible_value(const look *l, size_t k)
{
    static const double near = 0.1;

    return is_time_certain(l, k - 1, near) && is_time_certain(l, k, near) ? 0 : l->tol * l->size;
}

/* Find the last of eight times between occurrences k - 1 and k at which g clearly differs from 0; NaN: none. */
static qdot_status
find_last_visible_time(look *l, size_t k, double *t)
{
    enum { PLACES = 8 };
    const double a = l->t[k - 1], b = l->t[k];

    *t = NAN;
    for (int i = PLACES; i-- > 1 && isnan(*t);) {
        const double at = a + (b - a) * i / PLACES;
        bool seen;

        QDOT_TRY(differs_from_zero(l, at, least_visible_value(l, k), &seen));
        if (seen)
            *t = at;
    }
    return QDOT_OK;
}

/* Bisect between *a, where g clearly differs from 0, and *b, from which on it does not, until they
 * are `small` apart. */
static qdot_status
bisect_time_of_fading(look *l, double least, double small, double *a, double *b)
{
    while (fabs(*b - *a) > small) {
        const double middle = *a + (*b - *a) / 2;
        bool seen;

        if (middle == *a || middle == *b)
            break;
        QDOT_TRY(differs_from_zero(l, middle, least, &seen));
        *(seen ? a : b) = middle;
    }
    return QDOT_OK;
}

static qdot_status
find_time_of_fading(look *l, double *from)
{
    static const double sure = 1e-3;
    size_t k = l->n + 1; /* index of the time interval from t[k - 1] to t[k] */
    double seen = NAN, start, left;

    QDOT_TRY(find_function_size(l));
    for (; k > 0; k--) {
        QDOT_TRY(find_last_visible_time(l, k, &seen));
        if (isnan(seen) && k > 1 && is_time_certain(l, k - 1, sure))
            seen = l->t[k - 1];
        if (!isnan(seen))
            break;
    }
    if (k == 0 || k > l->n) /* g never differs from 0 by more than its error, or still does so at the end */
        return QDOT_OK;
    start = l->t[k];
    left = fabs(l->end - start);
    QDOT_TRY(bisect_time_of_fading(l, least_visible_value(l, k), fmin(left / 8, 1e-3 * fabs(l->t[l->n + 1] - l->t[0])), &seen, &start));
    /* for a crossing at the end of the run: before it g is within its error for as long as it would
     * be after it */
    if (left > 2 * fabs(l->t[k] - seen))
        *from = start;
    return QDOT_OK;
}

qdot_status
qdot_faded_find(qdot_run *run, size_t event, double *from)
{
    const qdot_course *c = &run->course;
    const qdot_staged_event *e = &run->stage.events.at[event];
    const double end = c->tr.t[c->tr.count - 1];
    look l = {0};
    qdot_status status = QDOT_OK;

    *from = NAN;
    for (size_t k = 0; k < c->faded.n; k++)
        if (c->faded.at[k].event == event && !c->faded.at[k].touched && c->faded.at[k].to == end)
            *from = c->faded.at[k].from;
    if (e->then || e->stop || c->tr.count < 2)
        return QDOT_OK;
    QDOT_TRY(qdot_run_twin(run));
    if (!qdot_run_comparable(run))
        return QDOT_OK;
    status = prepare_evaluation(run, event, isnan(*from) ? end : *from, &l);
    if (status == QDOT_OK && l.n > 0)
        status = find_time_of_fading(&l, from);
    clear_look(&l);
    return status;
}
