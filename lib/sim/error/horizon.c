/* horizon.c -- finds a run's horizon: the time at which run and companion runs have become independent. */
#include "sim/error/horizon.h"

#include <math.h>

#include "base/interrupt.h"
#include "ode/scale.h"
#include "sim/error/companion.h"
#include "sim/error/standstill.h"

/* The horizon is searched if the error at the end, relative to the state's variation, exceeds this. */
static const double worth_looking = 0.02;

/* A motion smaller than this many tolerances counts as rounding. */
static const double tolerances = 100;

/* The least fraction of the run beyond a horizon. */
static const double least_part = 0.01;

/* The number of times beyond the horizon at which expressions are compared. */
enum { LOOKS = 32 };

/* SAMPLES: points for estimating the variation first; at most MOST_POINTS, at least LEAST_POINTS are compared. */
enum { SAMPLES = 64, MOST_POINTS = 4096, LEAST_POINTS = 32 };

typedef struct {
    const qdot_run *run;
    const qdot_course *other; /* the companion run with which the run is compared */
    qdot_trajectory_cursor *companion;
    double *y;      /* [n] state of the companion run */
    size_t *point;  /* [points] indices of the run's points that are compared, in order */
    double *t, *d;  /* [points] times; distance of run and companion run at these times */
    size_t points, most; /* number of points compared; largest number compared at first */
    size_t read;         /* number of states of the companion run read so far */
    size_t *pieces; /* [points] index of the piece in which each point lies */
    double threshold;
} search;

/* --- variation of the state ---------------------------------------------------------- */

/* Find the least and the largest value of component i over every `stride`-th stored point. */
static void
find_component_range(const qdot_trajectory *tr, size_t i, size_t stride, double *low, double *high)
{
    for (size_t k = 0; k < tr->count; k += stride) {
        const double y = tr->y[k * tr->n + i];

        *low = y < *low ? y : *low;
        *high = y > *high ? y : *high;
    }
}

static double
state_variation(const double *scales, const qdot_trajectory *a, const qdot_trajectory *b,
                size_t stride)
{
    double most = 0;

    for (size_t i = 0; i < a->n; i++) {
        double low = INFINITY, high = -INFINITY;

        find_component_range(a, i, stride, &low, &high);
        if (b)
            find_component_range(b, i, stride, &low, &high);
        most = fmax(most, 0.5 * (high - low)
                               / qdot_ode_size(scales, i, fmax(fabs(low), fabs(high))));
    }
    return most;
}

/* Whether the variation is above x. A sample of the points is tried first: more can only raise
 * it. */
static bool
varies_by_more(const double *scales, const qdot_trajectory *tr, double x)
{
    if (x < 0.5 && state_variation(scales, tr, NULL, tr->count / SAMPLES + 1) > x)
        return true;
    return state_variation(scales, tr, NULL, 1) > x;
}

double
qdot_horizon_variation(const qdot_trajectory *tr)
{
    return state_variation(NULL, tr, NULL, 1);
}

/* --- distances of run and companion -------------------------------------------------- */

/* The number of initial pieces in which both trajectories have the same modes (equations). */
static size_t
count_common_pieces(const qdot_trajectory *a, const qdot_trajectory *b)
{
    size_t n = 0;

    while (n < a->pieces.n && n < b->pieces.n
           && a->pieces.at[n].mode == b->pieces.at[n].mode)
        n++;
    return n;
}

static double
distance_at_point(const search *s, size_t k)
{
    const qdot_trajectory *tr = &s->run->course.tr;
    double most = 0;

    for (size_t i = 0; i < tr->n; i++) {
        double y = tr->y[k * tr->n + i];

        most = fmax(most, fabs(y - s->y[i])
                              / qdot_ode_size(s->run->stage.scales, i,
                                              fmin(fabs(y), fabs(s->y[i]))));
    }
    return most;
}

/* The distance at point k of the run, which is of that piece; where the companion has no
 * state the one before stays. */
static qdot_status
measure_distance(search *s, size_t k, size_t piece, double *d)
{
    qdot_status status;

    QDOT_TRY(qdot_interrupt_check());
    s->read++;
    status = qdot_trajectory_read_piece(s->companion, piece, s->run->course.tr.t[k], s->y);
    if (qdot_grave(status) != QDOT_OK)
        return status;
    if (status == QDOT_OK)
        *d = distance_at_point(s, k);
    return QDOT_OK;
}

/* d at points of the run, as far as the companion goes the same way: at all of them, or at
 * one of every so many, without a pattern that a period could share. */
static qdot_status
measure_distances(search *s)
{
    const qdot_trajectory *a = &s->run->course.tr, *b = &s->other->tr;
    const double way = a->t[a->count - 1] < a->t[0] ? -1 : 1;
    const size_t pieces = count_common_pieces(a, b);
    const size_t end = pieces < a->pieces.n ? a->pieces.at[pieces].first : a->count;
    const size_t stride = end / s->most + 1;
    size_t piece = 0;
    double d = 0;

    for (size_t from = 0; from < end; from += stride) {
        size_t k = from + (size_t)((uint64_t)from * 2654435761U >> 7) % stride;

        k = from == 0 ? 0 : k < end ? k : end - 1;
        while (piece + 1 < pieces && a->pieces.at[piece + 1].first <= k)
            piece++;
        if (way * (a->t[k] - b->t[b->count - 1]) > 0 && piece + 1 == b->pieces.n)
            break; /* stop: the companion run ended earlier */
        QDOT_TRY(measure_distance(s, k, piece, &d));
        s->point[s->points] = k;
        s->pieces[s->points] = piece;
        s->t[s->points] = a->t[k];
        s->d[s->points++] = d;
    }
    return QDOT_OK;
}

/* Of the points that were left out before place k, in its piece, the first over the
 * threshold takes that place, with the last below it before. */
static qdot_status
measure_between_points(search *s, size_t k)
{
    const size_t piece = s->pieces[k];

    if (k == 0 || s->pieces[k - 1] != piece)
        return QDOT_OK;
    for (size_t i = s->point[k - 1] + 1; i < s->point[k]; i++) {
        double d = s->d[k - 1];

        QDOT_TRY(measure_distance(s, i, piece, &d));
        if (d >= s->threshold) {
            s->t[k] = s->run->course.tr.t[i];
            s->d[k] = d;
            return QDOT_OK;
        }
        s->t[k - 1] = s->run->course.tr.t[i];
        s->d[k - 1] = d;
    }
    return QDOT_OK;
}

/* --- finding the horizon ------------------------------------------------------------- */

/* The first point above the threshold after which d is above it for at least half of the time;
 * SIZE_MAX: none. */
static size_t
first_unreliable_point(const search *s)
{
    const double *t = s->t;
    double over = 0, all = 0;
    size_t first = SIZE_MAX;

    for (size_t k = s->points; k-- > 0;) {
        double step = k + 1 < s->points ? fabs(t[k + 1] - t[k]) : 0;

        all += step;
        if (!(s->d[k] >= s->threshold))
            continue;
        over += step;
        if (over >= 0.5 * all)
            first = k;
    }
    return first;
}

/* The mean over time, from point k on, of the distance d between run and companion run. */
static double
mean_distance_from(const search *s, size_t k)
{
    const double *t = s->t;
    double sum = 0, all = 0;

    for (; k + 1 < s->points; k++) {
        double step = fabs(t[k + 1] - t[k]);

        sum += 0.5 * step * (s->d[k] + s->d[k + 1]);
        all += step;
    }
    return all > 0 ? sum / all : s->d[k];
}

static double
time_of_threshold(const search *s, size_t k)
{
    const double *t = s->t;
    double low, high;

    if (k == 0 || !(s->d[k - 1] > 0) || !(s->d[k - 1] < s->threshold))
        return t[k];
    low = log(s->threshold / s->d[k - 1]);
    high = log(s->d[k] / s->d[k - 1]);
    return t[k - 1] + fmin(1, low / high) * (t[k] - t[k - 1]);
}

/* Find the time from which a companion run no longer follows the run; record it if earlier than the horizon so far. */
static qdot_status
find_horizon_of_companion(qdot_run *run, search *s)
{
    const qdot_trajectory *a = &run->course.tr, *b = &s->other->tr;
    const double way = run->t1 < run->t0 ? -1 : 1;
    qdot_run_report *report = &run->report;
    double size = state_variation(run->stage.scales, a, b, 1);
    const double length = fabs(a->t[a->count - 1] - a->t[0]);
    const size_t room = (a->count < s->most ? a->count : s->most) + 1;
    size_t first;
    double mean;

    s->run = run;
    s->threshold = QDOT_HORIZON_NONE_LEFT * size;
    s->y = qdot_malloc(a->n * sizeof *s->y);
    s->t = qdot_malloc(2 * room * sizeof *s->t);
    s->point = qdot_malloc(2 * room * sizeof *s->point);
    if (!s->y || !s->t || !s->point)
        return QDOT_ENOMEM;
    s->d = s->t + room;
    s->pieces = s->point + room;
    QDOT_TRY(qdot_trajectory_open(b, qdot_course_systems(s->other), &s->companion));
    QDOT_TRY(measure_distances(s));
    first = first_unreliable_point(s);
    if (first == SIZE_MAX || size < tolerances * fmax(report->tol, 0x1p-53)
        || fabs(a->t[a->count - 1] - s->t[first]) < least_part * length)
        return QDOT_OK;
    QDOT_TRY(measure_between_points(s, first));
    if (!(way * (time_of_threshold(s, first) - report->horizon) > 0))
        report->horizon = time_of_threshold(s, first);
    qdot_free(run->doubt); /* the horizon already says that the end is unreliable */
    run->doubt = NULL;
    mean = mean_distance_from(s, first);
    report->error = fmax(report->error, mean); /* also replaces a NaN by the mean */
    report->scaled_error = fmax(report->scaled_error, mean);
    return QDOT_OK;
}

/* The number of points that the remaining work budget allows to compare. */
static size_t
affordable_points(const qdot_run *run)
{
    const double left = qdot_companion_left(run->meter.work, run->report.estimate_work);

    return (size_t)fmax(LEAST_POINTS, fmin(MOST_POINTS, left / run->of_point));
}

static qdot_status
find_horizon_by(qdot_run *run, const qdot_course *other, size_t most)
{
    search s = {.other = other, .most = most};
    qdot_status status = find_horizon_of_companion(run, &s);

    run->report.estimate_work += 0.5 * run->of_point * (double)s.read;
    qdot_trajectory_close(s.companion);
    qdot_free(s.y);
    qdot_free(s.t);
    qdot_free(s.point);
    return status == QDOT_EDOMAIN || status == QDOT_EFAILED ? QDOT_OK : status;
}

qdot_status
qdot_horizon_find(qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_run_report *report = &run->report;
    size_t most;

    report->horizon = NAN;
    if (tr->count < 2)
        return QDOT_OK;
    if (report->scaled_error < worth_looking * tolerances * fmax(report->tol, 0x1p-53)
        || varies_by_more(run->stage.scales, tr, report->scaled_error / worth_looking))
        return QDOT_OK;
    /* use both companion runs: one may stay near the run for a while by chance */
    if (run->way != QDOT_COMPANION_WAYS)
        QDOT_TRY(qdot_run_twin(run));
    most = affordable_points(run);
    if (run->has_companion)
        QDOT_TRY(find_horizon_by(run, &run->companion, most));
    if (run->has_twin)
        QDOT_TRY(find_horizon_by(run, &run->twin, most));
    return isnan(report->horizon) ? QDOT_OK : qdot_standstill_find(run, &report->standstill);
}

bool
qdot_horizon_passed(const qdot_run *run, double t)
{
    return qdot_run_report_is_beyond(&run->report, t);
}

/* --- expressions beyond the horizon -------------------------------------------------- */

static qdot_status
compare_values_of_companions(qdot_reader *readers, double t, size_t m, double *values, double *spread)
{
    for (int which = 0; which < 2; which++)
        QDOT_TRY(qdot_reader_read(readers + which, NULL, t, values + (size_t)which * m));
    for (size_t j = 0; j < m; j++)
        spread[j] += fabs(values[j] - values[m + j]);
    return QDOT_OK;
}

qdot_status
qdot_horizon_spread(const qdot_run *run, const qdot_reading *of,
                    const qdot_course *const *own, size_t which, double *spread)
{
    const size_t m = of->m;
    const double from = run->report.horizon;
    const double end = run->course.tr.t[run->course.tr.count - 1];
    qdot_reader readers[2] = {0};
    double *values;
    const qdot_course **other;
    int count = 0;
    qdot_status status;

    for (size_t j = 0; j < m; j++)
        spread[j] = 0;
    if (isnan(from) || !run->has_companion)
        return QDOT_OK;
    values = qdot_calloc(2 * m, sizeof *values);
    other = qdot_calloc(1 + of->n_more, sizeof *other);
    status = values && other ? qdot_reader_init_along(readers, of, own) : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        for (size_t k = 0; k < 1 + of->n_more; k++)
            other[k] = k == which ? &run->companion : own[k];
        status = qdot_reader_init_along(readers + 1, of, other);
    }
    for (int k = 0; k < LOOKS && status == QDOT_OK; k++) {
        status =
            compare_values_of_companions(readers, from + (end - from) * (k + 0.5) / LOOKS, m, values, spread);
        if (status == QDOT_OK)
            count++;
        /* skip times at which a companion run is undefined or has ended */
        if (qdot_reader_has_nothing(status))
            status = QDOT_OK;
    }
    for (size_t j = 0; j < m && count > 0; j++)
        spread[j] /= count;
    qdot_reader_clear(readers);
    qdot_reader_clear(readers + 1);
    qdot_free(other);
    qdot_free(values);
    return status;
}
