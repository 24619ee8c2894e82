/* watch-resolution.c -- whether rounding of a part's polynomial hides what the function itself shows.
 *
 * A polynomial in Chebyshev's basis has one absolute error on all of its part, a small fraction of the
 * largest value there. Where a function is less than that, at an end of the part, at a node, at an extremum,
 * its polynomial has no sign; where it is more than its own rounding, it has one. Then the part is divided:
 * on a shorter one the function is not so small a part of itself.
 */
#include "sim/watch/watch-parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The error of a fitted polynomial, relative to its largest coefficient. */
static const double error_of_size = 0x1p-46;

int
qdot_watch_extrema(qdot_watch *w, const qdot_watch_part *p, size_t i, const double **x)
{
    double d[QDOT_WATCH_NODES], *to = w->extrema + i * QDOT_WATCH_NODES;

    *x = to;
    if (w->n_extrema[i] != QDOT_WATCH_UNKNOWN)
        return w->n_extrema[i] > 0 ? w->n_extrema[i] : 0;
    w->n_extrema[i] = 0;
    if (qdot_chebyshev_sign(p->n, p->c) == 0) {
        qdot_chebyshev_derivative(p->n, p->c, d);
        w->n_extrema[i] = qdot_chebyshev_crossings(p->n - 1, d, to);
    }
    return w->n_extrema[i] > 0 ? w->n_extrema[i] : 0;
}

/* The magnitude below which the sign of the fitted polynomial is unreliable. */
static double
least_reliable_value(const qdot_watch_part *p)
{
    return fmax(error_of_size * qdot_chebyshev_size(p->n, p->c), qdot_chebyshev_tail(p->n, p->c));
}

/* Whether g_i, of the given size at t (double-double if `sharp`), exceeds its rounding error. */
static qdot_status
exceeds_rounding(qdot_watch *w, const qdot_watch_part *p, size_t i, double t, double size, bool sharp, bool *is)
{
    double noise;

    QDOT_TRY(w->reader.read(t, w->z, w->reader.user));
    if (sharp)
        QDOT_TRY(qdot_watch_noise_two(w, t, w->z, i, &noise));
    else
        QDOT_TRY(qdot_watch_rounding(w, t, w->z, i, &noise));
    noise += p->from_zero ? fabs(qdot_watch_zero(w, i)) : 0;
    *is = size > QDOT_WATCH_ROUNDINGS * noise;
    return QDOT_OK;
}

/* The length of the shortest interval, relative to t. */
static const double shortest = 0x1p20 * DBL_EPSILON;

/* The fraction to be cut off at the start of the part, where the function is such a fraction of its size. The
 * next one is at least 16 times as long: however long the step, a few hundred parts come to its end. */
static double
length_of_start_cut(const qdot_watch *w, const qdot_watch_part *p, double fraction)
{
    const double length = fabs(p->b - p->a), cut = fmax(0x1p20 * sqrt(fraction), 0x1p-500),
                 least = fmax(15 * fabs(p->a - w->t), shortest * fabs(p->a)) / length;

    return fmin(fmax(cut, least), 0.5);
}

/* Whether the function leaves 0 at the start of the part, where it has the sign of g and its polynomial none,
 * so fast that there is no second sign until the polynomial tells it: at a slope of more than its error. The
 * derivative of a polynomial is at most n^2 times as large as it. */
static bool
is_clear_of_start_zero(const qdot_watch_part *p, double g, double least)
{
    double d[QDOT_WATCH_NODES], slope, error = (double)p->n * p->n * least;

    qdot_chebyshev_derivative(p->n, p->c, d);
    slope = copysign(1, g) * qdot_chebyshev_at(p->n - 1, d, -1);
    return slope > error
           && copysign(1, g) * qdot_chebyshev_at(p->n - 1, d, -1 + 4 * least / slope) > error;
}

qdot_status
qdot_watch_resolve(qdot_watch *w, const qdot_watch_part *p, size_t i, int nodes,
                   qdot_watch_verdict *v)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES, *x, least = least_reliable_value(p),
                 start = p->from_zero ? qdot_watch_zero(w, i) : 0;
    bool told = false;
    int n;

    *v = QDOT_PART_GOOD;
    if (w->deep[i] || qdot_watch_vanishes(w, p, i))
        return QDOT_OK;
    n = qdot_watch_extrema(w, p, i, &x);
    if (!p->from_zero && fabs(w->now.g0[i]) <= least && !is_clear_of_start_zero(p, w->now.g0[i], least)) {
        QDOT_TRY(exceeds_rounding(w, p, i, p->a, fabs(w->now.g0[i]), w->now.sharp[i], &told));
        if (told) {
            w->cut = length_of_start_cut(w, p, fabs(w->now.g0[i]) / qdot_chebyshev_size(p->n, p->c));
            *v = QDOT_PART_START_FAR;
            return QDOT_OK;
        }
    }
    if (fabs(p->at_end - start) <= least)
        QDOT_TRY(exceeds_rounding(w, p, i, p->b, fabs(p->at_end - start), qdot_watch_is_fine(w, i),
                                  &told));
    for (int j = 0; j < nodes && !told; j++) {
        const double t = qdot_watch_time(p, qdot_chebyshev_node(nodes, j)),
                     value = fabs(g[j] - start);

        if ((p->from_zero ? value * ((p->b - p->a) / (t - p->a)) : value) <= least)
            QDOT_TRY(exceeds_rounding(w, p, i, t, value, qdot_watch_is_fine(w, i), &told));
    }
    for (int e = 0; e < n && !told; e++) {
        const double t = qdot_watch_time(p, x[e]);

        if (fabs(qdot_chebyshev_at(p->n, p->c, x[e])) > least)
            continue;
        QDOT_TRY(qdot_watch_value_at(w, t, w->g));
        QDOT_TRY(exceeds_rounding(w, p, i, t, fabs(w->g[i] - start), qdot_watch_is_fine(w, i), &told));
    }
    if (told || w->n_extrema[i] == -1)
        *v = QDOT_PART_HALVED;
    return QDOT_OK;
}
