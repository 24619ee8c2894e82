/* batch.h -- eight systems at once, one a lane of a vector.
 *
 * Every number of a system is a group of QDOT_LANES doubles, lane l at [l]; a series is
 * such groups by order, coefficient k of lane l at [k QDOT_LANES + l]. All lanes do the
 * same operations, so what one processor instruction does it does for all of them.
 *
 * Everything exists three times, as in series.h: portable vectors of the compiler, AVX2 and
 * AVX-512 with fused multiplications; code of another floor is made for all three in the
 * same way (batch-kinds.def).
 *
 * Tests  tests/num/test_batch.c
 */
#ifndef QDOT_NUM_BATCH_H
#define QDOT_NUM_BATCH_H

#include <stddef.h>
#include <stdint.h>

#include "num/series.h"

#define QDOT_LANES 8

typedef void qdot_batch_dot(const double *a, const double *b, double *out);
typedef void qdot_batch_pair(const double *a, const double *b, const double *c,
                             double *out_b, double *out_c);

/* n series x_i, coefficient k of which is the group x[(i stride + k) QDOT_LANES]. The first
 * `checked` of them are places, whose rates are the `checked` behind those. */
typedef struct {
    size_t n, checked, stride;
    const double *x;
} qdot_batch_series;

/* y + carry, [n] groups. */
typedef struct {
    double *y, *carry;
} qdot_batch_sum;

/* A polynomial at the end of a step: its slopes there [n], its first coefficients [n], the state
 * [n]; the step in the units of before and of now, one group. */
typedef struct {
    const double *slope, *first, *next, *steps, *now;
    double share, rounding;
} qdot_batch_defect;

typedef struct {
    const char *name; /* "portable", "avx2", "avx512" */

    /* [n] for n = 0 ... QDOT_SERIES_MOST + 1: out = sum_{j=0..n-1} a[j] b[-j], groups; and
     * both sum a[j] b[-j] and sum a[j] c[-j]. An output may be an operand's newest. */
    qdot_batch_dot *dot[QDOT_SERIES_MOST + 2];
    qdot_batch_pair *pair[QDOT_SERIES_MOST + 2];

    /* The length of a step by orders from ... p of n series, log2 in units of s:
     *
     *     out = min_k (most_k - log2 max_i |x_ik| weight_i) inverse_k
     *
     * to 0.1, inverse_k = 1/k, and not beyond 1000 inverse_p or so; INFINITY where they all hold
     * nothing, NaN where they are not finite. n > 0, weight [n], out one group. */
    void (*log_steps)(const qdot_batch_series *series, int from, int p, const double *weight,
                      const double *inverse, const double *most, double *out);

    /* Of each series what is left of it from order 2 on,
     *
     *     value[i] = sum_{k=2..p} x_k s^(k-1),   slope[i] = sum_{k=1..p} k x_k s^(k-1),
     *
     * the latter of those from `checked` on. p >= 2; s is one group. */
    void (*tails)(const qdot_batch_series *series, int p, const double *s, double *value,
                  double *slope);

    /* The sum of such a series by twice the precision: to = from + s (x_1 + value) + s low, all
     * [n]; low_i = unit carry_{i + checked} for i < checked, else 0; unit is one group. */
    void (*advance)(const qdot_batch_series *series, const double *s, const double *unit,
                    const double *value, qdot_batch_sum from, qdot_batch_sum to);

    /* Sines and cosines of a group, each to 0.9 of a last place. A lane beyond 1e5, or not
     * finite, by the C library: the others know nothing of it. */
    void (*sincos)(const double *x, double *sine, double *cosine);

    /* out = 1/max(1, |y|), [n] */
    void (*weights)(size_t n, const double *y, double *out);

    /* Whether slopes of a polynomial are those of the equations: of the n - checked behind
     * `checked`, P = slope steps and f = x_1 now, steps and now one group,
     *
     *     |P - f| <= share size + rounding (|P| + |first steps| + size),
     *
     * size = max(1, |next|), and all x_1 finite. good, finite: a group of numbers, all bits
     * set or none. */
    void (*confirm)(const qdot_batch_series *series, const qdot_batch_defect *defect,
                    int64_t *good, int64_t *finite);
    /* to [n] = from in the lanes that are set. */
    void (*blend)(size_t n, const int64_t *set, const double *from, double *to);

    /* A [n x n], of which the first `positive` rows are positive definite and what these leave of
     * the others negative -> L below and on the diagonal, where 1/L_ii stands for L_ii:
     * A = L S L^T, S = 1 in those rows and -1 in the others. A lane of which that is not so, or to
     * less than 2^-40 of what the first rows take from a diagonal entry of the others, gets NaN
     * or infinities. */
    void (*factor)(size_t n, size_t positive, double *A);
    /* x [n] <- (L S L^T)^-1 x */
    void (*solve)(size_t n, size_t positive, const double *L, double *x);
    /* inverse [n x n] of L S L^T */
    void (*invert)(size_t n, size_t positive, const double *L, double *inverse);
    /* inverse of A [2 x 2], of which the upper corner is not read, by its cofactors; NaN in a
     * lane that is not positive definite. */
    void (*invert_two)(const double *A, double *inverse);
    /* y [n] = A x */
    void (*multiply)(size_t n, const double *A, const double *x, double *y);
} qdot_batch_kernels;

/* Those that fit this processor. */
const qdot_batch_kernels *qdot_batch_kernels_get(void);

/* Kind i, portable first, of those this processor can run; NULL beyond the last. */
const qdot_batch_kernels *qdot_batch_kernels_at(size_t i);

/* The kind that _get takes: the last there is (num/kinds.h). */
size_t qdot_batch_kind(void);

#endif
