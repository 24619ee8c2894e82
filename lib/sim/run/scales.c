/* scales.c -- finds the scales of a run: its largest coordinates and velocities, rounded to powers of ten. */
#include "sim/run/scales.h"

#include <float.h>
#include <math.h>

/* Coordinates whose largest magnitude is below this get scales of their own. */
static const double small = 1e-3;

/* A is no rounding if its error is below this part of it, and it is above that part of the largest
 * coordinate. */
static const double sure = 0.1, least_part = 1e-12;

/* Positions of two states without motion between them may differ by this fraction, because of rounding. */
static const double rounding = 8 * DBL_EPSILON;

/* A run with more work than this (in units of about 1 ns) is not repeated. */
static const double most_work = 3e8;

/* The most coordinates that a notice names. */
enum { MOST_NAMES = 4 };

/* The largest magnitude |y_i| at the stored points of the run. */
static double
largest_magnitude(const qdot_trajectory *tr, size_t i)
{
    double most = 0;

    for (size_t k = 0; k < tr->count; k++)
        most = fmax(most, fabs(tr->y[k * tr->n + i]));
    return most;
}

/* The largest |y_i| of a velocity, i >= n/2, at the stored points and between: it is somewhere its mean from one to the
 * next. (All may be where the motion turns back.) */
static double
largest_speed(const qdot_trajectory *tr, size_t i)
{
    double most = largest_magnitude(tr, i);

    for (size_t k = 1; k < tr->count; k++) {
        const double *y = tr->y + k * tr->n + i - tr->n / 2, before = *(y - tr->n);
        const double way = fabs(*y - before) - rounding * fabs(before);

        if (way > 0 && tr->t[k] != tr->t[k - 1])
            most = fmax(most, way / fabs(tr->t[k] - tr->t[k - 1]));
    }
    return most;
}

/* The largest power of ten that does not exceed x > 0. */
static double
power_of_ten_below(double x)
{
    return pow(10, floor(log10(x)));
}

/* Whether component i of the state is more than rounding: A is its largest size, `of` that of any
 * like it. */
static bool
is_value_reliable(const qdot_run *run, size_t i, double A, double of)
{
    return A > least_part * of && run->difference[i] < sure * A;
}

/* The largest magnitude of the components with indices first ... first + n - 1. */
static double
largest_of_components(const qdot_trajectory *tr, size_t first, size_t n)
{
    double most = 0;

    for (size_t i = 0; i < n; i++)
        most = fmax(most, largest_magnitude(tr, first + i));
    return most;
}

/* Find the scales of coordinates, found [n]; 0 for coordinates that need none. */
static void
find_coordinate_scales(const qdot_run *run, const qdot_run_request *request, size_t n,
                       double *found)
{
    const qdot_trajectory *tr = &run->course.tr;
    const double most = largest_of_components(tr, 0, n);
    const bool all = most < small;
    double largest = 0;

    for (size_t i = 0; i < n; i++) {
        const double A = largest_magnitude(tr, i);
        const bool shown = A < small && (all || run->start[i] != 0);

        found[i] = shown && is_value_reliable(run, i, A, most) ? power_of_ten_below(A) : 0;
        if (request->scales && request->scales[i] > 0)
            found[i] = request->scales[i];
        largest = fmax(largest, found[i]);
    }
    for (size_t i = 0; i < n && all; i++)
        if (found[i] == 0)
            found[i] = largest;
}

/* Find the scales of velocities: for coordinates that have a scale, or for all if every velocity is small. */
static void
find_velocity_scales(const qdot_run *run, const qdot_run_request *request, size_t n,
                     double *found)
{
    const qdot_trajectory *tr = &run->course.tr;
    const size_t N = tr->n / 2;
    double most = largest_of_components(tr, N, n), largest = 0, least_asked = INFINITY;
    bool slow;

    for (size_t i = 0; i < n && most < small; i++)
        most = fmax(most, largest_speed(tr, N + i));
    slow = most < small;
    for (size_t i = 0; i < n; i++) {
        const double A = found[i] > 0 || slow ? largest_speed(tr, N + i) : 0;

        found[n + i] = is_value_reliable(run, N + i, A, most) ? power_of_ten_below(A) : 0;
        if (request->scales && request->scales[n + i] > 0) {
            found[n + i] = request->scales[n + i];
            least_asked = fmin(least_asked, found[n + i]);
        } else {
            largest = fmax(largest, found[n + i]);
        }
    }
    if (largest == 0 && least_asked < INFINITY) /* at rest, zero velocities say little about the scales of others */
        largest = fmin(least_asked, 1);
    for (size_t i = 0; i < n; i++)
        if ((found[i] > 0 || slow) && found[n + i] == 0)
            found[n + i] = largest;
}

qdot_status
qdot_run_find_scales(qdot_run *run, const qdot_run_request *request, double *scales,
                     bool *found)
{
    const size_t n = run->plan->n - run->plan->n_states, N = run->plan->n;
    bool other = false;

    *found = false;
    if (run->course.tr.result.outcome == QDOT_ODE_FAILED || !run->difference)
        return QDOT_OK;
    find_coordinate_scales(run, request, n, scales);
    find_velocity_scales(run, request, n, scales);
    for (size_t i = 0; i < 2 * n; i++) {
        const size_t at = i < n ? i : N + i - n;
        const double now = run->stage.scales ? run->stage.scales[at] : 1;

        other = other || (scales[i] > 0 && scales[i] != now);
    }
    if (!other)
        return QDOT_OK;
    *found = run->meter.work < most_work;
    return *found ? QDOT_OK : qdot_run_say_scales(run, scales, false);
}

/* Whether all scales [n] are equal. */
static bool
are_equal_scales(const double *scales, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (scales[i] != scales[0])
            return false;
    return scales[0] > 0;
}

qdot_status
qdot_run_say_scales(qdot_run *run, const double *scales, bool hold)
{
    const size_t n = run->plan->n - run->plan->n_states;
    qdot_text *line = qdot_run_next_notice(run);
    size_t named = 0, first = 0;

    qdot_text_add(line, "scales found: ");
    if (n > 1 && are_equal_scales(scales, n) && are_equal_scales(scales + n, n)) {
        qdot_text_format(line, "%g for coordinates, %g for velocities", scales[0],
                         scales[n]);
    } else {
        for (size_t i = 0; i < 2 * n; i++) {
            const size_t k = i / 2 + (i % 2 ? n : 0);

            if (scales[k] > 0 && named++ < MOST_NAMES)
                qdot_text_format(line, "%s%s%s = %g", named > 1 ? ", " : "",
                                 run->plan->names[i / 2], i % 2 ? "'" : "", scales[k]);
        }
        if (named > MOST_NAMES)
            qdot_text_format(line, " and %zu more", named - MOST_NAMES);
    }
    while (first < 2 * n && !(scales[first] > 0))
        first++;
    if (hold)
        qdot_text_add(line, "; tol and errors are relative to max(scale, |value|)");
    else
        qdot_text_add(line, ", too costly to be run once more: tol and errors are relative to "
                            "max(1, |value|)");
    if (!hold && first < 2 * n)
        qdot_text_format(line, "; `scale %s%s = %g` sets another", run->plan->names[first % n],
                         first < n ? "" : "'", scales[first]);
    return qdot_text_status(&run->notice);
}
