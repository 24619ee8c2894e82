/* kit.h -- random numbers and the residual of a linear system. */
#ifndef QDOT_TESTS_NUM_KIT_H
#define QDOT_TESTS_NUM_KIT_H

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* In -1 ... 1. */
static inline double
uniform(void)
{
    return 2.0 * rand() / RAND_MAX - 1;
}

/* max |A x - b| over max |A| max |x|: small for any backward stable solver. */
static inline double
linear_residual(const double *a, size_t n, const double *x, const double *b)
{
    double worst = 0, size_a = 0, size_x = 0;

    for (size_t i = 0; i < n; i++) {
        long double r = -(long double)b[i];

        for (size_t j = 0; j < n; j++) {
            r += (long double)a[i * n + j] * x[j];
            size_a = fmax(size_a, fabs(a[i * n + j]));
        }
        worst = fmax(worst, fabsl(r));
        size_x = fmax(size_x, fabs(x[i]));
    }
    return worst / (size_a * size_x * n);
}

#endif
