/* interval.c -- bounds of sums, products, powers, sines and cosines over intervals. */
#include "num/interval.h"

#include <float.h>
#include <math.h>

/* Relative error assumed for functions of the C library. */
static const double off = 4 * DBL_EPSILON;

qdot_interval
qdot_interval_point(double x)
{
    return (qdot_interval){x, x};
}

bool
qdot_interval_is_point(qdot_interval a)
{
    return a.lo == a.hi;
}

qdot_interval
qdot_interval_around(qdot_interval a, qdot_interval b)
{
    return (qdot_interval){fmin(a.lo, b.lo), fmax(a.hi, b.hi)};
}

qdot_interval
qdot_interval_within(qdot_interval a, double least, double most)
{
    return (qdot_interval){fmin(fmax(a.lo, least), most), fmax(fmin(a.hi, most), least)};
}

qdot_interval
qdot_interval_outward(double lo, double hi)
{
    qdot_interval d = {nextafter(lo - off * fabs(lo), -INFINITY),
                       nextafter(hi + off * fabs(hi), INFINITY)};

    if (isnan(lo) || lo == -INFINITY)
        d.lo = -INFINITY;
    else if (lo == INFINITY)
        d.lo = DBL_MAX;
    if (isnan(hi) || hi == INFINITY)
        d.hi = INFINITY;
    else if (hi == -INFINITY)
        d.hi = -DBL_MAX;
    return d;
}

const qdot_interval qdot_interval_whole = {-INFINITY, INFINITY};

qdot_interval
qdot_interval_negative(qdot_interval a)
{
    return (qdot_interval){-a.hi, -a.lo};
}

qdot_interval
qdot_interval_size(qdot_interval a)
{
    return a.lo >= 0   ? a
           : a.hi <= 0 ? qdot_interval_negative(a)
                       : (qdot_interval){0, fmax(-a.lo, a.hi)};
}

qdot_interval
qdot_interval_rising(double (*f)(double), qdot_interval a)
{
    return qdot_interval_outward(f(a.lo), f(a.hi));
}

qdot_interval
qdot_interval_falling(double (*f)(double), qdot_interval a)
{
    return qdot_interval_outward(f(a.hi), f(a.lo));
}

qdot_interval
qdot_interval_sum(qdot_interval a, qdot_interval b)
{
    qdot_interval d = qdot_interval_outward(a.lo + b.lo, a.hi + b.hi);

    if (a.lo >= 0 && b.lo >= 0) /* the sum is not negative: rounding must not make it negative */
        d.lo = fmax(d.lo, 0);
    if (a.hi <= 0 && b.hi <= 0)
        d.hi = fmin(d.hi, 0);
    return d;
}

/* The least and the largest of f at the corners of a box; corners at which f is undefined are
 * skipped. */
static qdot_interval
bounds_at_corners(double (*f)(double, double), qdot_interval a, qdot_interval b)
{
    const double x[] = {f(a.lo, b.lo), f(a.lo, b.hi), f(a.hi, b.lo), f(a.hi, b.hi)};
    double lo = NAN, hi = NAN;

    for (int k = 0; k < 4; k++) {
        lo = fmin(lo, x[k]);
        hi = fmax(hi, x[k]);
    }
    return qdot_interval_outward(lo, hi);
}

/* The product of two bounds, with 0 times infinity = 0. */
static double
multiply_bounds(double x, double y)
{
    return x == 0 || y == 0 ? 0 : x * y;
}

static double
divide_bounds(double x, double y)
{
    return x / y;
}

qdot_interval
qdot_interval_product(qdot_interval a, qdot_interval b, bool same)
{
    qdot_interval d;

    if (same)
        return qdot_interval_within(
            bounds_at_corners(multiply_bounds, qdot_interval_size(a), qdot_interval_size(a)), 0, INFINITY);
    if ((a.lo == 0 && a.hi == 0) || (b.lo == 0 && b.hi == 0))
        return qdot_interval_point(0);
    d = bounds_at_corners(multiply_bounds, a, b);
    if ((a.lo >= 0 && b.lo >= 0) || (a.hi <= 0 && b.hi <= 0))
        d.lo = fmax(d.lo, 0);
    if ((a.lo >= 0 && b.hi <= 0) || (a.hi <= 0 && b.lo >= 0))
        d.hi = fmin(d.hi, 0);
    return d;
}

qdot_interval
qdot_interval_quotient(qdot_interval a, qdot_interval b)
{
    if (b.lo > 0 || b.hi < 0)
        return bounds_at_corners(divide_bounds, a, b);
    if (b.hi == 0) {
        a = qdot_interval_negative(a);
        b = qdot_interval_negative(b);
    }
    if (b.lo != 0 || b.hi == 0)
        return qdot_interval_whole;
    return a.lo >= 0   ? qdot_interval_outward(a.lo / b.hi, INFINITY)
           : a.hi <= 0 ? qdot_interval_outward(-INFINITY, a.hi / b.hi)
                       : qdot_interval_whole;
}

/* The maxima of the function (sine or cosine) lie at top + 2 pi k, the minima halfway between. */
qdot_interval
qdot_interval_wave(double (*f)(double), qdot_interval a, double top)
{
    const double slack = 16 * DBL_EPSILON * (1 + fmax(fabs(a.lo), fabs(a.hi)));
    const double turn = 2 * M_PI, lo = a.lo - slack, hi = a.hi + slack;
    qdot_interval d;

    if (!(hi - lo < turn))
        return (qdot_interval){-1, 1};
    d = qdot_interval_outward(fmin(f(a.lo), f(a.hi)), fmax(f(a.lo), f(a.hi)));
    if (top + turn * ceil((lo - top) / turn) <= hi)
        d.hi = 1;
    if (top + M_PI + turn * ceil((lo - top - M_PI) / turn) <= hi)
        d.lo = -1;
    return qdot_interval_within(d, -1, 1);
}

qdot_interval
qdot_interval_angle(qdot_interval y, qdot_interval x)
{
    if (x.lo > 0 || y.lo > 0 || y.hi < 0)
        return bounds_at_corners(atan2, y, x);
    return qdot_interval_outward(-M_PI, M_PI);
}

qdot_interval
qdot_interval_power(qdot_interval a, qdot_interval b)
{
    const bool even = qdot_interval_is_point(b) && fmod(b.lo, 2) == 0;

    if (even)
        a = qdot_interval_size(a);
    if (a.lo > 0 || (a.lo == 0 && b.lo >= 0)) /* includes base 0, since pow(0, 0) = 1 is an end of 0 < v^p <= 1 */
        return qdot_interval_within(bounds_at_corners(pow, a, b), 0, INFINITY);
    if (a.lo == 0 && qdot_interval_is_point(b))
        return (qdot_interval){qdot_interval_outward(pow(a.hi, b.lo), 0).lo, INFINITY};
    if (qdot_interval_is_point(b) && b.lo == floor(b.lo) && (b.lo > 0 || a.hi < 0))
        return bounds_at_corners(pow, a, b);
    if (qdot_interval_is_point(b) && b.lo == floor(b.lo) && a.hi == 0) /* an odd power: 1/x over -1..0 lies in -infinity..-1 */
        return qdot_interval_negative(qdot_interval_power(qdot_interval_negative(a), b));
    return qdot_interval_whole;
}

qdot_interval
qdot_interval_remainder(qdot_interval a, qdot_interval b)
{
    const qdot_interval q = qdot_interval_quotient(a, b);

    if (isfinite(q.lo) && floor(q.lo) == floor(q.hi))
        return qdot_interval_sum(a, qdot_interval_negative(qdot_interval_product(
                                        qdot_interval_point(floor(q.lo)), b, false)));
    return b.lo > 0   ? (qdot_interval){0, b.hi}
           : b.hi < 0 ? (qdot_interval){b.lo, 0}
                      : qdot_interval_whole;
}
