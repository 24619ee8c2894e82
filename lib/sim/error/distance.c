/* distance.c -- distance of run and companions at stored points, computed once; its largest value
 * near a time. */
#include "sim/error/distance.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "ode/companion.h"
#include "ode/scale.h"
#include "sim/error/companion.h"
#include "sim/error/oscillations.h"
#include "sim/course/chatter.h"

/* Angle in radians by which the path must turn both before and after t to count as turning. */
static const double least_turn = 0.5;

/* A component that moves by less than this many tolerances turns only because of rounding. */
static const double tolerances = 1000;

/* Factor by which the distance to the companion runs grows from one point to the next at a jump in time. */
static const double jump = 32;

/* The number of stored points near t from which the error of the companion runs at t is found. */
enum { near_points = 3 };

/* Where the companions are off nearby by more than so many times what they are off by at t, and by more than so large a
 * part of the value, the expression may be singular nearby: its error is found from that of the states. */
static const double poor = 1e3, poor_part = 1e-8;

/* The smallest error assumed for a companion run, as a fraction of the error of the run. */
static const double least_share = 1.0 / 32;

struct qdot_distance {
    const qdot_run *run;
    size_t m;
    qdot_reader own, others[2];
    size_t n_others;
    double share; /* fraction of the distance that may be the companion runs' own truncation error */
    double *at;   /* [points x m] estimated errors at the stored points */
    bool *known;  /* [points] the error at this point has been computed */
    double *unit; /* [n] 1/range of each component of the state; 0: component left out */
    double *work; /* [4m] scratch */
    double *aside; /* [3m] scratch */
    qdot_oscillations *over; /* fast oscillations that the run's steps may have missed; NULL: none */
};

void
qdot_distance_free(qdot_distance *d)
{
    if (!d)
        return;
    qdot_reader_clear(&d->own);
    for (size_t k = 0; k < d->n_others; k++)
        qdot_reader_clear(d->others + k);
    qdot_free(d->at);
    qdot_free(d->known);
    qdot_free(d->unit);
    qdot_free(d->work);
    qdot_free(d->aside);
    qdot_oscillations_free(d->over);
    qdot_free(d);
}

static void
find_component_units(qdot_distance *d)
{
    const qdot_trajectory *tr = &d->run->course.tr;

    for (size_t i = 0; i < tr->n; i++) {
        double low = INFINITY, high = -INFINITY, least;

        for (size_t k = 0; k < tr->count; k++) {
            low = fmin(low, tr->y[k * tr->n + i]);
            high = fmax(high, tr->y[k * tr->n + i]);
        }
        least = tolerances * fmax(d->run->report.tol, 0x1p-53)
                * qdot_ode_size(d->run->stage.scales, i, fmax(fabs(low), fabs(high)));
        d->unit[i] = high - low > least ? 1 / (high - low) : 0;
    }
}

qdot_status
qdot_distance_new(qdot_run *run, const qdot_reading *of, qdot_distance **out)
{
    const qdot_course *courses[] = {&run->companion, &run->twin};
    const qdot_trajectory *tr = &run->course.tr;
    qdot_distance *d = qdot_calloc(1, sizeof *d);
    const size_t m = of->m;
    qdot_status status;

    if (!(*out = d))
        return QDOT_ENOMEM;
    d->run = run;
    d->share = !run->has_twin ? QDOT_COMPANION_ALONE
                              : fmin(1, fmax(least_share, 4 * run->companion.tr.tol / run->report.tol))
                                    * QDOT_COMPANION_SHARE;
    d->m = m;
    d->at = qdot_calloc(tr->count * m + 1, sizeof *d->at);
    d->known = qdot_calloc(tr->count + 1, sizeof *d->known);
    d->unit = qdot_calloc(tr->n + 1, sizeof *d->unit);
    d->work = qdot_calloc(4 * m + 1, sizeof *d->work);
    d->aside = qdot_calloc(3 * m + 1, sizeof *d->aside);
    status = d->at && d->known && d->unit && d->work && d->aside ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_reader_init(&d->own, of, &run->course);
    for (size_t k = 0; k < (run->has_twin ? 2 : 1) && status == QDOT_OK; k++) {
        d->n_others = k + 1;
        status = qdot_reader_init(d->others + k, of, courses[k]);
        /* the companion runs of a double-double run share the rounding of the states that are read */
        d->others[k].moved = run->leading ? (int)k + 1 : 0;
    }
    if (status == QDOT_OK && d->own.n_courses == 1)
        status = qdot_oscillations_new(&run->course, &d->over);
    if (status == QDOT_OK)
        find_component_units(d);
    else
        qdot_distance_free(d);
    if (status != QDOT_OK)
        *out = NULL;
    return status;
}

/* --- differences at one time --------------------------------------------------------- */

/* At t in a piece: the distance of `values` from the middle of the companions' into out [m], what these
 * may be off by themselves into own [m]. NaN where one has no values. */
static qdot_status
compare_with_companions(qdot_distance *d, size_t piece, double t, const double *values, double *out,
                        double *own)
{
    double *first = d->work, *theirs = first;
    bool there = qdot_run_covered(d->run, t);

    for (size_t k = 0; k < d->n_others && there; k++, theirs += d->m) {
        const size_t pieces = (k == 0 ? &d->run->companion : &d->run->twin)->tr.pieces.n;
        const size_t same = piece < pieces ? piece : pieces - 1; /* a piece of the run without duration */
        qdot_status status = qdot_reader_at(d->others + k, same, t, theirs);

        if (status != QDOT_OK && !qdot_reader_has_nothing(status))
            return status;
        there = status == QDOT_OK;
    }
    for (size_t j = 0; j < d->m; j++) {
        const double both[] = {first[j], first[(d->n_others - 1) * d->m + j]};

        out[j] = there ? qdot_companion_apart(values[j], d->n_others, both) : NAN;
        own[j] = there ? fmax(qdot_companion_own(both), d->share * out[j]) : 0;
    }
    return QDOT_OK;
}

/* Find the error that the companion runs may have themselves at stored point k; 0 if unknown. */
static qdot_status
find_difference_at_point(qdot_distance *d, size_t piece, size_t k, const double **out)
{
    const qdot_trajectory *tr = &d->run->course.tr;
    double *values = d->work + 2 * d->m, *by = values + d->m, *at = d->at + k * d->m;
    qdot_status status;

    *out = at;
    if (d->known[k])
        return QDOT_OK;
    status = qdot_reader_at(&d->own, piece, tr->t[k], values);
    if (status == QDOT_OK)
        status = compare_with_companions(d, piece, tr->t[k], values, by, at);
    if (status != QDOT_OK && !qdot_reader_has_nothing(status))
        return status;
    for (size_t j = 0; j < d->m; j++)
        if (status != QDOT_OK || !isfinite(at[j]))
            at[j] = 0;
    d->known[k] = true;
    return QDOT_OK;
}

/* --- windows of time around a point -------------------------------------------------- */

/* The angle at stored point k between the chords of the path before and after it. */
static double
angle_of_path(const qdot_distance *d, size_t k)
{
    const qdot_trajectory *tr = &d->run->course.tr;
    const double *y = tr->y + k * tr->n;
    double before = 0, behind = 0, product = 0;

    for (size_t i = 0; i < tr->n; i++) {
        double a = d->unit[i] * (y[i] - y[i - tr->n]);
        double b = d->unit[i] * (y[i + tr->n] - y[i]);

        before += a * a;
        behind += b * b;
        product += a * b;
    }
    product /= sqrt(before * behind);
    return isnan(product) ? 0 : acos(fmax(-1, fmin(1, product)));
}

static bool
is_outside_compared_times(const qdot_run *run, double t)
{
    return run->limited
           && !(fmin(run->within[0], run->within[1]) <= t
                && t <= fmax(run->within[0], run->within[1]));
}

/* Whether the clock of a run that is timed by one goes twice as fast, or half as fast, at point k as
 * at another: values that are singular where it stands still are not alike there. */
static bool
has_other_clock_rate(const qdot_trajectory *tr, size_t k, size_t other)
{
    const double *rate = tr->y + tr->clock + tr->n / 2;
    const double ratio = tr->s ? fabs(rate[k * tr->n] / rate[other * tr->n]) : 1;

    return !(0.5 <= ratio && ratio <= 2);
}

/* Whether what the companions were off by k points away from t tells nothing of t, beside what they are
 * off by near it, the first few points, and between: it has died out by then, or one of them jumped
 * there a little before the other. Beside a zero of order n they differ as k^n, from each point to the next
 * beyond the first few at most by (4/3)^n. */
static bool
is_distant_difference(double at, double near, double between, int k)
{
    return k >= near_points && (at > near * pow(2 * k, 3) || at > jump * between);
}

/* The largest over the points on one side, from k on in steps of `way`, into out [m];
 * *cut: a neighbouring piece, or what may be compared, ends it early. */
static qdot_status
find_largest_on_one_side(qdot_distance *d, size_t piece, size_t k, int way, double *out, bool *cut)
{
    const qdot_trajectory *tr = &d->run->course.tr;
    const size_t first = tr->pieces.at[piece].first, last = qdot_trajectory_last_of(tr, piece);
    const size_t begin = k;
    double turned = 0, *near = d->aside + 2 * d->m;

    for (size_t j = 0; j < d->m; j++)
        out[j] = near[j] = 0;
    *cut = false;
    for (int points = 0; points < QDOT_DISTANCE_POINTS && turned < least_turn; points++) {
        const double *at;

        *cut = is_outside_compared_times(d->run, tr->t[k]);
        if (*cut || has_other_clock_rate(tr, k, begin))
            return QDOT_OK;
        QDOT_TRY(find_difference_at_point(d, piece, k, &at));
        for (size_t j = 0; j < d->m; j++) {
            if (points < near_points)
                near[j] = fmax(near[j], at[j]);
            if (!is_distant_difference(at[j], near[j], out[j], points))
                out[j] = fmax(out[j], at[j]);
        }
        if (k == (way > 0 ? last : first)) {
            *cut = k > 0; /* at the start of the run there is nothing before the point */
            return QDOT_OK;
        }
        if (k > first && k < last)
            turned += angle_of_path(d, k);
        k = way > 0 ? k + 1 : k - 1;
    }
    return QDOT_OK;
}

/* Raise own [m] to the errors that the companion runs may have themselves near t, which lies after point k. */
static qdot_status
find_difference_near(qdot_distance *d, size_t piece, size_t k, double *own)
{
    double *left = d->aside, *right = left + d->m;
    bool left_cut, right_cut = true;

    QDOT_TRY(find_largest_on_one_side(d, piece, k, -1, left, &left_cut));
    if (k < qdot_trajectory_last_of(&d->run->course.tr, piece))
        QDOT_TRY(find_largest_on_one_side(d, piece, k + 1, 1, right, &right_cut));
    else
        memcpy(right, left, d->m * sizeof *right);
    for (size_t j = 0; j < d->m; j++) {
        double by = left_cut == right_cut ? fmin(left[j], right[j])
                    : left_cut            ? right[j]
                                          : left[j];

        own[j] = fmax(own[j], left_cut && right_cut ? fmax(left[j], right[j]) : by);
    }
    return QDOT_OK;
}

/* At time s: the state of the run less the middle of the companions into apart [n], that of one companion less the other
 * into between [n]. *there: all three have a state. y [n] is room. */
static qdot_status
compare_states_with_companions(qdot_distance *d, size_t piece, double s, double *y, double *apart, double *between, bool *there)
{
    const size_t n = 2 * d->own.courses->n;
    qdot_status status = qdot_reader_at(&d->own, piece, s, d->work);

    memcpy(y, d->own.courses->in, n * sizeof *y);
    for (size_t k = 0; k < 2 && status == QDOT_OK; k++) {
        const size_t pieces = (k == 0 ? &d->run->companion : &d->run->twin)->tr.pieces.n;

        status = qdot_reader_at(d->others + k, piece < pieces ? piece : pieces - 1, s, d->work);
    }
    *there = status == QDOT_OK;
    for (size_t i = 0; i < n && *there; i++) {
        const double a = d->others[0].courses->in[i], b = d->others[1].courses->in[i];

        apart[i] = y[i] - (2 * a + b) / 3;
        between[i] = a - b;
    }
    return qdot_reader_has_nothing(status) ? QDOT_OK : status;
}

/* How much the expressions at t change if `by` [n] is added to the state y there, times `part`, where that is more than
 * most [m] so far. */
static qdot_status
find_change_by_state_shift(qdot_distance *d, double t, const double *y, const double *by, double part, const double *values,
                           double *most)
{
    const size_t n = 2 * d->own.courses->n;
    double *in = d->own.courses->in, *moved = d->work;

    for (size_t i = 0; i < n; i++)
        in[i] = y[i] + by[i];
    QDOT_TRY(qdot_reader_evaluate(&d->own, t, moved));
    for (size_t j = 0; j < d->m; j++)
        most[j] = fmax(most[j], isfinite(moved[j]) ? part * fabs(moved[j] - values[j]) : INFINITY);
    return QDOT_OK;
}

/* The same as find_difference_near by what the companions' states are off by nearby, carried over to t: of an expression that is
 * singular at a point nearby, such as 1/y at a bounce, own [m] is that at most. here [m]: what they are off by at t. */
static qdot_status
limit_error_by_states(qdot_distance *d, size_t piece, size_t k, double t, const double *values, const double *here,
                      double *own)
{
    const qdot_trajectory *tr = &d->run->course.tr;
    const size_t first = tr->pieces.at[piece].first, last = qdot_trajectory_last_of(tr, piece);
    const size_t n = 2 * d->own.courses->n, from = k > first + QDOT_DISTANCE_POINTS ? k - QDOT_DISTANCE_POINTS : first;
    double *y, *room, *apart, *between, *most;
    bool is_poor = false;
    qdot_status status = QDOT_OK;

    for (size_t j = 0; j < d->m; j++)
        is_poor = is_poor || (own[j] > poor * here[j] && own[j] > poor_part * fabs(values[j]));
    if (!is_poor || d->n_others < 2 || d->own.n_courses > 1)
        return QDOT_OK;
    y = qdot_calloc(4 * n + d->m + 1, sizeof *y);
    if (!y)
        return QDOT_ENOMEM;
    room = y + n;
    apart = room + n;
    between = apart + n;
    most = between + n;
    for (size_t s = from; s <= last && s <= k + QDOT_DISTANCE_POINTS && status == QDOT_OK; s++) {
        bool there;

        status = compare_states_with_companions(d, piece, tr->t[s], room, apart, between, &there);
        if (status == QDOT_OK)
            status = qdot_reader_at(&d->own, piece, t, d->work);
        memcpy(y, d->own.courses->in, n * sizeof *y);
        if (status == QDOT_OK && there)
            status = find_change_by_state_shift(d, t, y, between, 2.0 / 3, values, most);
        if (status == QDOT_OK && there)
            status = find_change_by_state_shift(d, t, y, apart, d->share, values, most);
    }
    for (size_t j = 0; j < d->m && status == QDOT_OK; j++)
        own[j] = fmin(own[j], fmax(here[j], most[j]));
    qdot_free(y);
    return qdot_reader_has_nothing(status) ? QDOT_OK : status;
}

qdot_status
qdot_distance_at(qdot_distance *d, double t, const double *values, double *out)
{
    const qdot_trajectory *tr = &d->run->course.tr;
    const size_t k = qdot_trajectory_locate(tr, t, 0), piece = qdot_trajectory_piece_of(tr, k);
    const bool chatters = d->own.n_courses == 1 && qdot_chatters_at(&d->run->course, t);
    double *own = qdot_malloc((2 * d->m + 1) * sizeof *own), *here = own + d->m;
    qdot_status status = own ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_interrupt_check();
    if (status == QDOT_OK)
        status = compare_with_companions(d, piece, t, values, out, own);
    if (status == QDOT_OK) {
        memcpy(here, own, d->m * sizeof *here);
        status = find_difference_near(d, piece, k, own);
    }
    if (status == QDOT_OK)
        status = limit_error_by_states(d, piece, k, t, values, here, own);
    for (size_t j = 0; j < d->m && status == QDOT_OK; j++)
        out[j] = isnan(out[j]) ? NAN : qdot_companion_bound(out[j], own[j]);
    if (status == QDOT_OK && (d->over || chatters))
        status = qdot_reader_at(&d->own, piece, t, own);
    if (status == QDOT_OK && d->over)
        status = qdot_oscillations_add(d->over, &d->own, t, own, out);
    if (status == QDOT_OK && chatters)
        status = qdot_chatter_add(&d->run->course, &d->own, t, own, out);
    qdot_free(own);
    return status;
}
