/* sum.c -- compensated sums over arrays. */
#include "num/sum.h"

#include <math.h>

double
qdot_sum_array(const double *x, size_t n)
{
    qdot_sum s = {0};

    for (size_t i = 0; i < n; i++)
        qdot_sum_add(&s, x[i]);
    return qdot_sum_value(&s);
}

double
qdot_sum_dot(const double *x, const double *y, size_t n)
{
    qdot_sum s = {0};

    for (size_t i = 0; i < n; i++) {
        double p = x[i] * y[i];

        s.carry += fma(x[i], y[i], -p);
        qdot_sum_add(&s, p);
    }
    return qdot_sum_value(&s);
}
