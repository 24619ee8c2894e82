/* series.h -- kernels for truncated power series, in which Taylor integration spends most of its
 * time.
 *
 * A series is an array of coefficients by order. The Cauchy product's coefficient
 *
 *     (a b)_k = sum_{j=0..k} a_j b_{k-j}
 *
 * is a sum of n = k + 1 terms in which one factor is read forwards and the other
 * backwards. For each n there is a function of its own, unrolled by the compiler over
 * four accumulators. The two outermost terms hold the newest coefficients and are added
 * last, so that a processor runs the others ahead of them.
 *
 * All kernels exist three times: portable C, and for x86 with fused multiplications
 * (AVX2, AVX-512); the best that the processor can run are chosen once. The last
 * bits of a result may differ between the three.
 *
 * Tests  tests/num/test_series.c
 */
#ifndef QDOT_NUM_SERIES_H
#define QDOT_NUM_SERIES_H

#include <stddef.h>

/* The highest order of a Taylor series for which there are unrolled functions. */
#define QDOT_SERIES_MOST 48

/* The sum of products sum_{j=0..n-1} a[j] b[-j], for the n for which the function was compiled. */
typedef double qdot_series_dot(const double *a, const double *b);

/* The sums of the products a[j] b[-j] and a[j] c[-j] over j = 0..n-1. */
typedef struct {
    double b, c;
} qdot_series_two;
typedef qdot_series_two qdot_series_pair(const double *a, const double *b,
                                         const double *c);

typedef struct {
    double upper, lower;
} qdot_series_reach;

/* For `reach`, by order: the factors of the logarithms of coefficients, and the terms from which
 * they are subtracted, infinite at orders that do not count; 1/k; and bounds of the results for
 * coefficients that are not all zero. */
typedef struct {
    int p;
    double term, fall;
    double inverse[QDOT_SERIES_MOST + 8];
    double share[QDOT_SERIES_MOST + 8];
    double upper[QDOT_SERIES_MOST + 8], lower[QDOT_SERIES_MOST + 8];
    double upper_most, lower_most, lower_least;
} qdot_series_weights;

void qdot_series_weights_set(qdot_series_weights *w, int p, double term, double fall);

/* next + next_carry = y + carry + sum_{k=1..p} x_k s^k, sums of two doubles, in twice the
 * precision except for the terms from order 2 on. The derivatives of the first `linked`
 * components are the others, in their order: the carry of these enters order 1. */
typedef struct {
    size_t n, linked;
    const double *x; /* [n x stride] Taylor coefficients: order k of component i at x[i stride + k] */
    size_t stride;
    int p;
    double s, unit;          /* the time advances by `unit` times s */
    /* All of these arrays have room for 8 more numbers: */
    const double *y, *carry; /* [n] the state as two doubles: it is y + carry */
    double *next, *next_carry;
    const double *least;  /* [n] positive lower bounds of the sizes of the components (ode/scale.h) */
    double *size, *scale; /* [n] size of each component, max(least, |next|), and the inverse of the size */
    /* [n] Only for components from `linked` on: the derivative at the end times the step, sum k
     * x_k s^k, and the sum of the sizes of its terms, of x_1 s and of `size`. */
    double *slope, *terms;
} qdot_series_step;

typedef struct {
    const char *name; /* kind of processor: "portable", "avx2", "avx512" */

    /* dot[n], pair[n]: functions that sum n products, n = 0 ... QDOT_SERIES_MOST + 1 */
    qdot_series_dot *dot[QDOT_SERIES_MOST + 2];
    qdot_series_pair *pair[QDOT_SERIES_MOST + 2];

    /* Sums of n products for m series at once, m a multiple of 8, coefficients by order, then
     * member: out[i] = sum_{j=0..n-1} a[j m + i] b[-j m + i]. */
    void (*dots)(size_t m, size_t n, const double *a, const double *b, double *out);

    /* The tail from order 2 on of each of n series x [i stride + k],
     *
     *     value[i] = sum_{k=2..p} x_k s^(k-1),
     *
     * and slope[i] = sum_{k=1..p} k x_k s^(k-1). slope may be NULL. */
    void (*tails)(size_t n, const double *x, size_t stride, int p, double s,
                  double *value, double *slope);

    /* A bound for the change of a variable by its Taylor series: sum_{k=1..p} |x_k| |s|^k. */
    double (*span)(const double *x, int p, double s);

    /* peaks[k] = max_i scale[i] |x[i stride + k]|, k = 0 ... p, infinite or NaN if a coefficient
     * is; orders are padded to a multiple of 8, as are stride and the size of peaks. */
    void (*peaks)(size_t n, const double *x, size_t stride, int p, const double *scale,
                  double *peaks);

    /* The length of a step: with m_k = max_i scale[i] |x[i stride + k]|, k = 0 ... p,
     *
     *     upper = min over p/2 < k <= p      of  (fall (p - k) - log2(m_k))/k
     *     lower = min over 2 <= k <= p/2     of  (term - log2(m_k))/k
     *
     * to 0.09/k. Infinite if all these are zero; upper is -infinity if one of its
     * m_k is infinite or NaN. stride is a multiple of 8. */
    qdot_series_reach (*reach)(size_t n, const double *x, size_t stride,
                               const qdot_series_weights *w, const double *scale);

    /* Advance a state by its Taylor series (qdot_series_step). */
    void (*advance)(const qdot_series_step *step);

    /* y [m] = sum_{j=0..n-1} A[j m + ...] x[j], m a multiple of 8: a matrix by its
     * columns, filled up to m rows. y may not be x. */
    void (*multiply)(size_t m, size_t n, const double *A, const double *x, double *y);
    /* Add a multiple of a vector: y[j] += c a[j], j = 0 ... n-1. */
    void (*add)(size_t n, double c, const double *a, double *y);
} qdot_series_kernels;

/* The best kernels that this processor can run. */
const qdot_series_kernels *qdot_series_kernels_get(void);

/* Kind i of kernels among those that this processor can run, the portable one first; NULL past the last. */
const qdot_series_kernels *qdot_series_kernels_at(size_t i);

#endif
