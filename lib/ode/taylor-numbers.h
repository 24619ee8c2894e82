/* taylor-numbers.h -- bounds and helper functions for a step by Taylor series.
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

/* The error that steps aim at: less than the tolerance, which the errors of thousands of steps
 * share, tol^(5/4), but at least 1e-17, a tenth of the rounding of a double, unless the first
 * orders are sums of two doubles (leading.h). */
static inline double
qdot_step_aim(double tol, bool leading)
{
    const double aim = tol * sqrt(sqrt(tol));

    return leading ? aim : fmax(aim, 1e-17);
}

/* Terms of the upper half may exceed a geometric fall to the error that a step of order p aims
 * at, if that fall is less than 2^(2/3) an order; the result is log2 of the allowed factor an
 * order. */
static inline double
qdot_step_fall(double log_aim, int p)
{
    return fmax(0, 2.0 / 3 + log_aim / p);
}

/* The log2 of the largest term of a series, relative to the state, whose rounding error may matter. */
static inline double
qdot_step_term(double log_aim)
{
    return fmax(-1, log_aim + 53);
}

/* The length of the shortest step that is allowed at time t. */
static inline double
qdot_step_floor(double t)
{
    t = fabs(t);
    return fmax(16 * (nextafter(t, INFINITY) - t), 16 * DBL_MIN);
}

/* Whether h is shorter than that. The spacing of doubles at t is |t| over a number between 2^52
 * and 2^53, so it is rarely needed. */
static inline bool
qdot_step_is_too_short(double t, double h)
{
    return !(h > 16 * DBL_EPSILON * fabs(t) && h > 16 * DBL_MIN) && h < qdot_step_floor(t);
}

/* The largest power of two that is not above |h|, with the sign of h: the unit of time of a series. */
static inline double
qdot_step_unit(double h)
{
    uint64_t bits;

    memcpy(&bits, &h, sizeof bits);
    bits &= (uint64_t)0xfff << 52;
    if ((bits << 1) == 0) /* zero or subnormal */
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

/* The power 2^x with an error of 0.002, to estimate a step; exp2 would take as long as three orders of a series. */
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
