/* two.h -- numbers as the sum of two doubles: about 31 digits.
 *
 *     x = hi + lo,   |lo| <= ulp(hi)/2
 *
 * Errors: sums 2^-104 (|a| + |b|), products and quotients 2^-102 relative; undefined if hi
 * overflows or lo would be below 2^-1022. Functions have a relative error below 2^-68, or that
 * which an error of 2^-104 in the argument causes, if larger.
 *
 * Source  Dekker, Numer. Math. 18 (1971) 224; Hida, Li & Bailey, Proc. 15th IEEE Symp.
 *         Computer Arithmetic (2001) 155; Joldes, Muller & Popescu, ACM TOMS 44 (2017) 15.
 * Tests   tests/num/test_two.c
 */
#ifndef QDOT_NUM_TWO_H
#define QDOT_NUM_TWO_H

#include <math.h>
#include <stddef.h>

typedef struct {
    double hi, lo;
} qdot_two;

/* Inlined into kernels that are compiled for several processors. */
#define QDOT_TWO_INLINE static inline __attribute__((always_inline))

/* The sum a + b rounded, and its rounding error (as qdot_two_sum of num/sum.h). */
QDOT_TWO_INLINE double
qdot_two_rounded_sum(double a, double b, double *e)
{
    const double s = a + b, bb = s - a;

    *e = (a - (s - bb)) + (b - bb);
    return s;
}

/* The number hi + lo as a pair, where |lo| must not exceed |hi|. */
QDOT_TWO_INLINE qdot_two
qdot_two_of(double hi, double lo)
{
    const double s = hi + lo;

    return (qdot_two){s, lo - (s - hi)};
}

QDOT_TWO_INLINE qdot_two
qdot_two_neg(qdot_two a)
{
    return (qdot_two){-a.hi, -a.lo};
}

QDOT_TWO_INLINE qdot_two
qdot_two_add(qdot_two a, qdot_two b)
{
    double e;
    const double s = qdot_two_rounded_sum(a.hi, b.hi, &e);

    return qdot_two_of(s, e + (a.lo + b.lo));
}

QDOT_TWO_INLINE qdot_two
qdot_two_sub(qdot_two a, qdot_two b)
{
    return qdot_two_add(a, qdot_two_neg(b));
}

QDOT_TWO_INLINE qdot_two
qdot_two_add_double(qdot_two a, double b)
{
    double e;
    const double s = qdot_two_rounded_sum(a.hi, b, &e);

    return qdot_two_of(s, e + a.lo);
}

QDOT_TWO_INLINE qdot_two
qdot_two_mul(qdot_two a, qdot_two b)
{
    const double p = a.hi * b.hi, e = fma(a.hi, b.hi, -p);

    return qdot_two_of(p, fma(a.hi, b.lo, fma(a.lo, b.hi, e)));
}

QDOT_TWO_INLINE qdot_two
qdot_two_mul_double(qdot_two a, double b)
{
    const double p = a.hi * b;

    return qdot_two_of(p, fma(a.lo, b, fma(a.hi, b, -p)));
}

/* The product of a and a power of two, which is exact. */
QDOT_TWO_INLINE qdot_two
qdot_two_scale(qdot_two a, double power)
{
    return (qdot_two){power * a.hi, power * a.lo};
}

QDOT_TWO_INLINE qdot_two
qdot_two_div(qdot_two a, qdot_two b)
{
    const double q = a.hi / b.hi;
    const qdot_two left = qdot_two_sub(a, qdot_two_mul_double(b, q));

    return qdot_two_of(q, left.hi / b.hi);
}

QDOT_TWO_INLINE qdot_two
qdot_two_div_double(qdot_two a, double b)
{
    const double q = a.hi / b;

    return qdot_two_of(q, (fma(-q, b, a.hi) + a.lo) / b);
}

QDOT_TWO_INLINE qdot_two
qdot_two_sqrt(qdot_two a)
{
    const double r = sqrt(a.hi);

    if (!(r > 0))
        return (qdot_two){r, 0};
    return qdot_two_of(r, (fma(-r, r, a.hi) + a.lo) / (2 * r));
}

/* An unfinished sum of products: sum + rest, normalised only at the end. */
typedef struct {
    double sum, rest;
} qdot_two_dot;

QDOT_TWO_INLINE void
qdot_two_dot_add(qdot_two_dot *d, qdot_two a, qdot_two b)
{
    const double p = a.hi * b.hi;
    double e;

    d->rest += fma(a.hi, b.lo, fma(a.lo, b.hi, fma(a.hi, b.hi, -p)));
    d->sum = qdot_two_rounded_sum(d->sum, p, &e);
    d->rest += e;
}

QDOT_TWO_INLINE qdot_two
qdot_two_dot_value(qdot_two_dot d)
{
    return qdot_two_of(d.sum, d.rest);
}

/* Functions for sums of products in twice the precision, compiled for one kind of processor. */
typedef struct {
    qdot_two (*mul)(qdot_two a, qdot_two b);
    /* The sums of products sum_{j<n} a[j] b[j] and sum_{j<n} a[j] b[-j]. */
    qdot_two (*dot)(size_t n, const qdot_two *a, const qdot_two *b);
    qdot_two (*convolve)(size_t n, const qdot_two *a, const qdot_two *b);
    /* Compute powers of s: two[k] = s^k for k <= m, power[k] = s^k as a double for k <= p; p >= m >= 1. */
    void (*powers)(qdot_two s, int m, int p, qdot_two *two, double *power);
    /* Sum a Taylor series: sum_{k=0..m} first[k] two[k] + sum_{k=m+1..p} x[k] power[k]. */
    qdot_two (*series)(int m, int p, const qdot_two *first, const qdot_two *two,
                       const double *x, const double *power);
} qdot_two_kernels;

const qdot_two_kernels *qdot_two_kernels_get(void);
const qdot_two_kernels *qdot_two_kernels_at(size_t i);

/* Elementary functions, for the processor at hand; NaN where undefined, as in libm. Each may be
 * called by several threads at once. */
typedef struct {
    void (*sincos)(qdot_two x, qdot_two *sine, qdot_two *cosine);
    void (*sinhcosh)(qdot_two x, qdot_two *sine, qdot_two *cosine);
    qdot_two (*exp)(qdot_two x);
    qdot_two (*log)(qdot_two x);
    qdot_two (*pow)(qdot_two x, qdot_two y);
    qdot_two (*tanh)(qdot_two x);
    qdot_two (*asin)(qdot_two x);
    qdot_two (*acos)(qdot_two x);
    qdot_two (*atan)(qdot_two x);
    qdot_two (*atan2)(qdot_two y, qdot_two x);
    qdot_two (*asinh)(qdot_two x);
    qdot_two (*acosh)(qdot_two x);
    qdot_two (*atanh)(qdot_two x);
    qdot_two (*erf)(qdot_two x);
    qdot_two (*erfc)(qdot_two x);
} qdot_two_functions;

/* The best functions that this processor can run; their tables are filled by the first call. */
const qdot_two_functions *qdot_two_functions_get(void);
/* Kind i of functions among those that this processor can run, the portable one first; NULL past the last. */
const qdot_two_functions *qdot_two_functions_at(size_t i);

#endif
