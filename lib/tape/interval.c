/* interval.c -- a tape over intervals. */
#include "tape/interval.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "tape/instruction.h"

/* --- bounds -------------------------------------------------------------------------- */

/* Relative error of the library's functions. */
static const double off = 4 * DBL_EPSILON;

static qdot_interval
point(double x)
{
    return (qdot_interval){x, x};
}

static bool
is_point(qdot_interval a)
{
    return a.lo == a.hi;
}

static bool
is_true(qdot_interval a)
{
    return a.lo > 0 || a.hi < 0;
}

static bool
is_false(qdot_interval a)
{
    return a.lo == 0 && a.hi == 0;
}

static qdot_interval
either(bool surely, bool never)
{
    return (qdot_interval){surely, !never};
}

static qdot_interval
around(qdot_interval a, qdot_interval b)
{
    return (qdot_interval){fmin(a.lo, b.lo), fmax(a.hi, b.hi)};
}

/* The part of an interval in least ... most: elsewhere the function is undefined. */
static qdot_interval
within(qdot_interval a, double least, double most)
{
    return (qdot_interval){fmin(fmax(a.lo, least), most), fmax(fmin(a.hi, most), least)};
}

static double
softplus(double x)
{
    return fmax(x, 0) + log1p(exp(-fabs(x)));
}

/* Round outward. A lower bound that overflows becomes the largest double: the exact value is
 * finite. */
static qdot_interval
outward(double lo, double hi)
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

static const qdot_interval whole = {-INFINITY, INFINITY};

static qdot_interval
of_negative(qdot_interval a)
{
    return (qdot_interval){-a.hi, -a.lo};
}

static qdot_interval
of_size(qdot_interval a)
{
    return a.lo >= 0   ? a
           : a.hi <= 0 ? of_negative(a)
                       : (qdot_interval){0, fmax(-a.lo, a.hi)};
}

static qdot_interval
of_rising(double (*f)(double), qdot_interval a)
{
    return outward(f(a.lo), f(a.hi));
}

static qdot_interval
of_falling(double (*f)(double), qdot_interval a)
{
    return outward(f(a.hi), f(a.lo));
}

static qdot_interval
of_sum(qdot_interval a, qdot_interval b)
{
    return outward(a.lo + b.lo, a.hi + b.hi);
}

/* The least and the largest of f at the corners of a box; corners at which f is undefined are
 * skipped. */
static qdot_interval
of_corners(double (*f)(double, double), qdot_interval a, qdot_interval b)
{
    const double x[] = {f(a.lo, b.lo), f(a.lo, b.hi), f(a.hi, b.lo), f(a.hi, b.hi)};
    double lo = NAN, hi = NAN;

    for (int k = 0; k < 4; k++) {
        lo = fmin(lo, x[k]);
        hi = fmax(hi, x[k]);
    }
    return outward(lo, hi);
}

/* A product with 0 times infinity = 0. */
static double
times(double x, double y)
{
    return x == 0 || y == 0 ? 0 : x * y;
}

static double
over(double x, double y)
{
    return x / y;
}

static qdot_interval
of_product(qdot_interval a, qdot_interval b, bool same)
{
    if (same)
        return within(of_corners(times, of_size(a), of_size(a)), 0, INFINITY);
    return of_corners(times, a, b);
}

static qdot_interval
of_quotient(qdot_interval a, qdot_interval b)
{
    if (is_true(b))
        return of_corners(over, a, b);
    if (b.hi == 0) {
        a = of_negative(a);
        b = of_negative(b);
    }
    if (b.lo != 0 || b.hi == 0)
        return whole;
    return a.lo >= 0   ? outward(a.lo / b.hi, INFINITY)
           : a.hi <= 0 ? outward(-INFINITY, a.hi / b.hi)
                       : whole;
}

/* The highest points of the wave lie at top + 2 pi k, the lowest halfway between. */
static qdot_interval
of_wave(double (*f)(double), qdot_interval a, double top)
{
    const double slack = 16 * DBL_EPSILON * (1 + fmax(fabs(a.lo), fabs(a.hi)));
    const double turn = 2 * M_PI, lo = a.lo - slack, hi = a.hi + slack;
    qdot_interval d;

    if (!(hi - lo < turn))
        return (qdot_interval){-1, 1};
    d = outward(fmin(f(a.lo), f(a.hi)), fmax(f(a.lo), f(a.hi)));
    if (top + turn * ceil((lo - top) / turn) <= hi)
        d.hi = 1;
    if (top + M_PI + turn * ceil((lo - top - M_PI) / turn) <= hi)
        d.lo = -1;
    return within(d, -1, 1);
}

static qdot_interval
of_angle(qdot_interval y, qdot_interval x)
{
    if (x.lo > 0 || is_true(y))
        return of_corners(atan2, y, x);
    return outward(-M_PI, M_PI);
}

static qdot_interval
of_power(qdot_interval a, qdot_interval b)
{
    const bool even = is_point(b) && fmod(b.lo, 2) == 0;

    if (even)
        a = of_size(a);
    if (a.lo > 0 || (a.lo == 0 && b.lo > 0))
        return within(of_corners(pow, a, b), 0, INFINITY);
    if (a.lo == 0 && is_point(b))
        return (qdot_interval){outward(pow(a.hi, b.lo), 0).lo, INFINITY};
    if (is_point(b) && b.lo == floor(b.lo) && (b.lo > 0 || a.hi < 0))
        return of_corners(pow, a, b);
    return whole;
}

static qdot_interval
of_remainder(qdot_interval a, qdot_interval b)
{
    const qdot_interval q = of_quotient(a, b);

    if (isfinite(q.lo) && floor(q.lo) == floor(q.hi))
        return of_sum(a, of_negative(of_product(point(floor(q.lo)), b, false)));
    return b.lo > 0 ? (qdot_interval){0, b.hi} : b.hi < 0 ? (qdot_interval){b.lo, 0} : whole;
}

/* --- a tape -------------------------------------------------------------------------- */

size_t
qdot_interval_work(const qdot_tape *tape)
{
    return tape->places;
}

/* The operation on numbers, as the tape has it. */
static void
on_points(const qdot_instruction *i, double a, double b, double c, qdot_interval *to,
          qdot_interval *second)
{
    double d = 0, e = 0;

    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, slopes)                      \
    case QDOT_OP_##ID: statement; break;
#include "tape/operation.def"
#undef X
    }
    (void)b, (void)c;
    *to = isfinite(d) ? point(d) : isnan(d) ? whole : outward(d, d);
    *second = isfinite(e) ? point(e) : whole;
}

static void
step(const qdot_instruction *i, qdot_interval *work)
{
    const int operands = qdot_operations[i->op].operands;
    const qdot_interval a = work[i->x], b = operands > 1 ? work[i->y] : point(0);
    const qdot_interval c = operands > 2 ? work[i->z] : point(0);
    const bool same = operands > 1 && i->x == i->y;
    qdot_interval d = whole, e = whole;

    if (is_point(a) && is_point(b) && is_point(c))
        on_points(i, a.lo, b.lo, c.lo, &d, &e);
    else
        switch (i->op) {
#define X(ID, result)                                                                    \
    case QDOT_OP_##ID: result; break;
#include "tape/interval.def"
#undef X
        }
    work[i->to] = d;
    if (i->op == QDOT_OP_SINCOS)
        work[i->y] = e;
}

void
qdot_interval_eval(const qdot_tape *tape, const qdot_interval *in, qdot_interval *out,
                   qdot_interval *work)
{
    if (tape->inputs)
        memcpy(work, in, tape->inputs * sizeof *work);
    for (size_t k = 0; k < tape->constants; k++)
        work[tape->inputs + k] = point(tape->constant[k]);
    for (size_t k = 0; k < tape->length; k++)
        step(tape->code + k, work);
    for (size_t k = 0; k < tape->outputs; k++)
        out[k] = work[tape->output[k]];
}
