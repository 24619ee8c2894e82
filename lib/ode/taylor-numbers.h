/* taylor-numbers.h -- numbers that a step by Taylor series is made with.
 *
 * Tests  tests/ode/test_taylor.c
 */
#ifndef QDOT_ODE_TAYLOR_NUMBERS_H
#define QDOT_ODE_TAYLOR_NUMBERS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Steps aim at less than the tolerance, which the errors of thousands of them may share:
 * at tol^(5/4), down to a tenth of what the first of two doubles can hold. */
static inline double
qdot_step_aim(double tol)
{
    return fmax(tol * sqrt(sqrt(tol)), 1e-17);
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
