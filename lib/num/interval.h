/* interval.h -- intervals of the extended real line: bounds of elementary operations.
 *
 *     a in A, b in B, a op b defined   =>   a op b in A op B
 *
 * Bounds are moved outward by the rounding of the operation, that of the library's functions by
 * 4 DBL_EPSILON. A bound is infinite if there is none, never NaN.
 *
 * Source  Moore, Kearfott & Cloud, Introduction to Interval Analysis (2009), chapters 2 and 5.
 * Tests   tests/tape/test_interval.c, tests/normal/solve/test_zeros.c
 */
#ifndef QDOT_NUM_INTERVAL_H
#define QDOT_NUM_INTERVAL_H

#include <stdbool.h>

typedef struct {
    double lo, hi;
} qdot_interval;

extern const qdot_interval qdot_interval_whole; /* the interval of all numbers */

qdot_interval qdot_interval_point(double x);
bool qdot_interval_is_point(qdot_interval a);
/* The smallest interval that contains both intervals. */
qdot_interval qdot_interval_around(qdot_interval a, qdot_interval b);
/* The part of the interval a inside least ... most, such as the domain of a function. */
qdot_interval qdot_interval_within(qdot_interval a, double least, double most);
/* lo ... hi rounded outward. A lower bound that overflows becomes the largest double: the exact value is
 * finite. */
qdot_interval qdot_interval_outward(double lo, double hi);

qdot_interval qdot_interval_negative(qdot_interval a);
qdot_interval qdot_interval_size(qdot_interval a); /* the interval of |x| */
qdot_interval qdot_interval_sum(qdot_interval a, qdot_interval b);
/* The product of two intervals; `same`: both factors have the same value, so that it is a square. */
qdot_interval qdot_interval_product(qdot_interval a, qdot_interval b, bool same);
qdot_interval qdot_interval_quotient(qdot_interval a, qdot_interval b);
qdot_interval qdot_interval_power(qdot_interval a, qdot_interval b);
/* the interval of x - y floor(x/y) */
qdot_interval qdot_interval_remainder(qdot_interval a, qdot_interval b);
qdot_interval qdot_interval_angle(qdot_interval y, qdot_interval x); /* the interval of atan2(y, x) */
/* The image of the interval a under a function that is increasing (qdot_interval_falling: decreasing) on it. */
qdot_interval qdot_interval_rising(double (*f)(double), qdot_interval a);
qdot_interval qdot_interval_falling(double (*f)(double), qdot_interval a);
/* Bounds of sin (top = pi/2) or cos (top = 0): maxima at top + 2 pi k, minima halfway between. */
qdot_interval qdot_interval_wave(double (*f)(double), qdot_interval a, double top);

#endif
