/* step-decisions.h -- what is decided of a step, and the numbers of these decisions, the same in every
 * arithmetic: in doubles (taylor.c, adaptive-steps.c, geometric/constant-steps.c), in lanes (batch.c), in MPFR (precise.c).
 *
 * Pure functions: they change nothing.
 *
 * Tests  tests/ode/test_taylor.c
 */
#ifndef QDOT_ODE_STEP_DECISIONS_H
#define QDOT_ODE_STEP_DECISIONS_H

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

/* --- attempts ----------------------------------------------------------------------- */

/* Attempts at one place that fail because f is undefined beyond it, or the end does not confirm them: each
 * is a quarter of the one before, so as many reach the spacing of doubles from any step. */
enum { QDOT_STEP_ATTEMPTS = 60 };
static const double qdot_step_quarter = 0.25;

/* A step that would leave less than this part of the way ends with it. */
static const double qdot_step_sliver = 1e-12;

/* The end of a step of h > 0 from t, rounded to a double: `until` if it comes near that; if the rest would be
 * shorter than the step, half of the way there, unless `whole`. */
static inline double
qdot_step_end(double t, double until, double direction, double h, bool whole)
{
    const double rest = direction * (until - t);
    double end;

    if (h >= rest * (1 - qdot_step_sliver))
        return until;
    end = t + direction * (h > 0.5 * rest && !whole ? 0.5 * rest : h);
    return direction * (until - end) > 0 ? end : until;
}

/* --- the end of a step confirms it, or not ------------------------------------------------ */

/* The defect at the end, times the length of the step, that confirms an order p under tol, relative to the
 * size of a component; and what rounding may add to it, relative to the terms of the series. */
static inline double
qdot_step_share(int p, double tol)
{
    return 10 * (p + 1) * tol;
}

static const double qdot_step_rounding = 64 * DBL_EPSILON;

/* Places inside a step, without a pattern, where it is looked at too if its series may be the whole solution. */
enum { QDOT_STEP_PLACES = 2 };
static const double qdot_step_places[QDOT_STEP_PLACES] = {0.31830988618379067, 0.70710678118654752};

/* How far a projection onto the constraints may move the end of a step that is held to the accuracy `held`: also
 * by about its own rounding error, whatever the tolerance. */
static inline double
qdot_step_most_moved(double held)
{
    return 100 * held + 1e-13;
}

/* --- the unit of time of a series ------------------------------------------------------------ */

/* A unit is changed if the step differs from it by more than this power of two, so often at one place. */
enum { QDOT_STEP_UNIT_FAR = 8, QDOT_STEP_UNITS = 8 };

/* log2 of the factor by which the unit is changed after `tries` changes if coefficients overflow. */
static inline double
qdot_step_overflow(int64_t tries)
{
    return -10 - 40 * (double)tries;
}

/* The unit nearer to a step that is 2^far units long. */
static inline double
qdot_step_other_unit(double unit, double far)
{
    return ldexp(unit, (int)fmax(-300, fmin(300, floor(far))));
}

/* What is narrower than this part of t is no hidden part of f: a divisor that comes down to 0 there divides 0, a pole
 * that nothing turns about. */
static const double qdot_step_narrowest = 0x1p-26;

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
