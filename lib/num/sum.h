/* sum.h -- compensated summation: a sum kept as (value, rounding error).
 *
 *     s + e = a + b exactly,   s = fl(a + b)
 *
 * Source  Knuth, TAOCP 2, 4.2.2 theorem B (TwoSum); Neumaier, ZAMM 54 (1974) 39.
 * Tests   tests/num/test_sum.c
 */
#ifndef QDOT_NUM_SUM_H
#define QDOT_NUM_SUM_H

/* s = fl(a + b) returned, *e = (a + b) - s exactly, whatever the sizes of a and b.
 * If s overflows *e is not a number. */
static inline double
qdot_two_sum(double a, double b, double *e)
{
    double s = a + b, bb = s - a;

    *e = (a - (s - bb)) + (b - bb);
    return s;
}

/* A running sum; start from {0}. sum + carry is the total to about twice the precision. */
typedef struct {
    double sum, carry;
} qdot_sum;

static inline void
qdot_sum_add(qdot_sum *s, double x)
{
    double e;

    s->sum = qdot_two_sum(s->sum, x, &e);
    s->carry += e;
}

static inline double
qdot_sum_value(const qdot_sum *s)
{
    return s->sum + s->carry;
}

/* Add x to a number kept as hi + lo, and keep |lo| <= ulp(hi)/2. */
static inline void
qdot_sum_advance(double *hi, double *lo, double x)
{
    *hi = qdot_two_sum(*hi, *lo + x, lo);
}

/* Advance by x + rest, |rest| below a rounding of x: *lo + rest is not rounded to places of x, which
 * would drop rest every time. */
static inline void
qdot_sum_advance_by(double *hi, double *lo, double x, double rest)
{
    double e;
    const double at = qdot_two_sum(*hi, x, &e);

    *hi = qdot_two_sum(at, e + (*lo + rest), lo);
}

#endif
