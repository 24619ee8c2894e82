/* taylor-numbers.h -- numbers that a step by Taylor series is made with.
 *
 * Tests  tests/ode/test_taylor.c
 */
#ifndef QDOT_ODE_TAYLOR_NUMBERS_H
#define QDOT_ODE_TAYLOR_NUMBERS_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Steps aim at less than the tolerance, which the errors of thousands of them may share:
 * at tol^(5/4), down to a tenth of what the first of two doubles can hold unless the first
 * orders are sums of two (leading.h). */
static inline double
qdot_step_aim(double tol, bool leading)
{
    const double aim = tol * sqrt(sqrt(tol));

    return leading ? aim : fmax(aim, 1e-17);
}

/* log2 of what a term of the upper half may be larger, an order, than one of a steady fall to
 * the error that a step of order p aims at: where that falls by less than 2^(2/3) an order. */
static inline double
qdot_step_fall(double log_aim, int p)
{
    return fmax(0, 2.0 / 3 + log_aim / p);
}

/* log2 of the largest term, over the size of the state, whose rounding may count. */
static inline double
qdot_step_term(double log_aim)
{
    return fmax(-1, log_aim + 53);
}

/* No step is shorter. */
static inline double
qdot_step_floor(double t)
{
    t = fabs(t);
    return fmax(16 * (nextafter(t, INFINITY) - t), 16 * DBL_MIN);
}

/* The spacing is the size over a number between 2^52 and 2^53: seldom worth the look. */
static inline bool
qdot_step_is_too_short(double t, double h)
{
    return !(h > 16 * DBL_EPSILON * fabs(t) && h > 16 * DBL_MIN) && h < qdot_step_floor(t);
}

/* The power of two at or below |h|, with the sign of h. */
static inline double
qdot_step_unit(double h)
{
    uint64_t bits;

    memcpy(&bits, &h, sizeof bits);
    bits &= (uint64_t)0xfff << 52;
    if ((bits << 1) == 0) /* not a normal number */
        return h != 0 ? copysign(ldexp(1, ilogb(h)), h) : 1;
    memcpy(&h, &bits, sizeof h);
    return h;
}

static inline void
qdot_swap(double **a, double **b)
{
    double *c = *a;

    *a = *b;
    *b = c;
}

static inline double
qdot_larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double
qdot_smaller(double a, double b)
{
    return a < b ? a : b;
}

/* 2^x to 0.002: the step it is for is a guess, and the libraries' takes as long as three
 * orders of a series. */
static inline double
qdot_rough_exp2(double x)
{
    double whole, part, power;
    int64_t bits;

    if (!(fabs(x) < 1000))
        return exp2(x);
    whole = (double)(int64_t)x;
    whole -= whole > x;
    part = x - whole;
    bits = ((int64_t)whole + 1023) << 52;
    memcpy(&power, &bits, sizeof power);
    return power * (1 + part * (0.6565 + 0.3435 * part));
}

#endif
