/* near.c -- the sum grows with the step: halving finds it. */
#include "series/near.h"

#include <math.h>

enum { halvings = 20 };

double
qdot_near_limit(int p, double u0, double digits)
{
    return fmax(0.5 * (p + 1), fabs(u0) - digits - QDOT_NEAR_BEYOND);
}

static double
sum(int p, const double *log2_sizes, double log2_h)
{
    double sum = 0;

    for (int k = 1; k <= p; k++)
        sum += exp2(log2_sizes[k] + k * log2_h);
    return sum;
}

double
qdot_near_log2(int p, const double *log2_sizes, double limit, double log2_h)
{
    double high = INFINITY, low; /* one term alone is the limit; each is a part of it */

    for (int k = 1; k <= p; k++)
        if (log2_sizes[k] > -INFINITY)
            high = fmin(high, (log2(limit) - log2_sizes[k]) / k);
    low = high - log2(p);
    if (!(log2_h > low))
        return log2_h;
    high = fmin(high, log2_h);
    if (sum(p, log2_sizes, high) <= limit)
        return high;
    for (int i = 0; i < halvings; i++) {
        const double middle = 0.5 * (low + high);

        if (sum(p, log2_sizes, middle) <= limit)
            low = middle;
        else
            high = middle;
    }
    return low;
}
