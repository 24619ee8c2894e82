/* range-poles.c -- finds poles of an expression along a run: intervals, however short, that no polynomial fits. */
#include "sim/read/range-parts.h"

/* A part that no polynomial fits however short it is holds a jump, or a pole where values are
 * so many times those of the step; a pole whose integral exists leaves that little of it. */
static const double beyond_bounds = 0x1p16, least_integral = 0x1p-20;

/* Towards a point where no polynomial fits, values are compared at distances that fall to a quarter
 * each time. What grows by increments that fall by less than `slow` (a logarithm's do not fall)
 * grows beyond all. */
enum { NEAREST = 4, INCREMENTS = 10, LEAST_INCREMENTS = 4 };
static const double far_beside = 1024, grown = 8;
static const double slow = 0.994;

/* Whether the expression has finite bounds in the interval, so that there is no pole. */
static bool
has_finite_bounds(const qdot_range_scan *s)
{
    return isfinite(s->bounds.box->lo) && isfinite(s->bounds.box->hi);
}

/* The largest magnitude, near a short interval, of values that do not yet indicate a pole. */
static double
largest_value_without_pole(qdot_range_scan *s, const qdot_range_part *p)
{
    double most = 0;

    if (s->typical > 0)
        return beyond_bounds * s->typical;
    for (int side = -1; side <= 1; side += 2) { /* typical size 0: allow 8 times the values beside the interval */
        double t = p->a + side * far_beside * (p->b - p->a), v;

        if (fmin(s->ends[0], s->ends[1]) <= t && t <= fmax(s->ends[0], s->ends[1])
            && qdot_reader_read(&s->reader, s->pieces, t, &v) == QDOT_OK && isfinite(v))
            most = fmax(most, grown * fabs(v));
    }
    return most;
}

/* Decide whether an interval that cannot be halved any more contains a pole of the expression. */
void
qdot_range_look_for_pole(qdot_range_scan *s, const qdot_range_part *p)
{
    const double most = largest_value_without_pole(s, p);
    double low = INFINITY, high = -INFINITY;

    for (int j = 0; j < p->n; j++) {
        low = fmin(low, p->values[j]);
        high = fmax(high, p->values[j]);
    }
    if (has_finite_bounds(s) || (high <= most && low >= -most))
        return;
    s->above = s->above || high > most;
    s->below = s->below || low < -most;
    s->diverges = s->diverges
                  || fmax(high, -low) * fabs(p->b - p->a)
                         > least_integral * s->typical * s->length;
    s->pole = p->b;
}

/* Values at lengths 2^NEAREST, 2^(NEAREST + 2) ... of the part beside its middle, as far as the step
 * goes, as increments [..] towards it and the nearest value; how many. */
static int
find_increments_towards_middle(qdot_range_scan *s, const qdot_range_part *p, int side, double *d, double *nearest)
{
    const double w = fabs(p->b - p->a), middle = 0.5 * (p->a + p->b);
    double before = 0;
    int n = 0;

    for (; n <= INCREMENTS; n++) {
        double t = middle + side * ldexp(w, NEAREST + 2 * n), v;

        if (t < fmin(s->ends[0], s->ends[1]) || t > fmax(s->ends[0], s->ends[1])
            || qdot_reader_read(&s->reader, s->pieces, t, &v) != QDOT_OK || !isfinite(v))
            break;
        if (n == 0)
            *nearest = v;
        else
            d[n - 1] = before - v;
        before = v;
    }
    return n - 1;
}

/* Whether successive increments change by about the same factor, unlike those of noise. */
static bool
is_geometric(const double *d, int n, double *ratio)
{
    *ratio = n > 1 ? pow(d[0] / d[n - 1], 1.0 / (n - 1)) : NAN;
    for (int k = 0; k + 1 < n; k++) {
        double r = d[k] / d[k + 1];

        if (!(r > 0.5 * *ratio && r < 2 * *ratio))
            return false;
    }
    return n >= LEAST_INCREMENTS && *ratio > 0;
}

/* The sum of the increments after d[0]: they fall by a ratio each time, or ever more slowly, as
 * those of 1/log, for which as many more are assumed as there were. */
static double
remaining_growth(const double *d, int n, double ratio, double before)
{
    const double late = d[0] / d[1], early = d[n - 2] / d[n - 1];

    if (ratio >= slow)
        return copysign(INFINITY, d[0]);
    return d[0] * fmax(late > 0.8 && late > early + 0.01 ? before : 0, ratio / (1 - ratio));
}

/* The limit of the values towards the part from one side: increments that fall as a power add up
 * to a limit, others have none. */
static void
extrapolate_from_side(qdot_range_scan *s, const qdot_range_part *p, int side)
{
    double d[INCREMENTS + 1], nearest = 0, ratio, limit;
    const int n = find_increments_towards_middle(s, p, side, d, &nearest);

    if (n < LEAST_INCREMENTS || !is_geometric(d, n, &ratio)
        || !(fabs(d[0]) > fmax(4 * DBL_EPSILON * fabs(nearest), QDOT_RANGE_NOISES * s->noise)))
        return;
    limit = nearest + remaining_growth(d, n, ratio, 0.5 * log2(s->length / fabs(p->b - p->a)));
    s->highest = fmax(s->highest, limit);
    s->lowest = fmin(s->lowest, limit);
    if (isinf(limit)) {
        s->above = s->above || limit > 0;
        s->below = s->below || limit < 0;
        s->pole = 0.5 * (p->a + p->b);
    }
}

void
qdot_range_look_towards(qdot_range_scan *s, const qdot_range_part *p)
{
    if (has_finite_bounds(s))
        return;
    extrapolate_from_side(s, p, 1);
    extrapolate_from_side(s, p, -1);
}
