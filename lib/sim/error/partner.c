/* partner.c -- finds the root (time of an event) of a companion run that corresponds to the run's k-th root. */
#include "sim/error/partner.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* The index of the time nearest to t in at [n]; SIZE_MAX if n is 0. */
static size_t
index_of_nearest(const double *at, size_t n, double t)
{
    const bool down = n > 1 && at[n - 1] < at[0];
    size_t low = 0, high = n;

    if (n == 0)
        return SIZE_MAX;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;

        if (down ? at[middle] >= t : at[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return high < n && fabs(at[high] - t) < fabs(at[low] - t) ? high : low;
}

size_t
qdot_partner_of(const double *own, size_t n, size_t k, const double *other, size_t m)
{
    size_t best;
    double away;

    if (n == m)
        return k;
    best = index_of_nearest(other, m, own[k]);
    if (best == SIZE_MAX)
        return SIZE_MAX;
    away = fabs(other[best] - own[k]);
    if ((k > 0 && away > 0.1 * fabs(own[k - 1] - own[k]))
        || (k + 1 < n && away > 0.1 * fabs(own[k + 1] - own[k])))
        return SIZE_MAX;
    return best;
}
