/* batch.h -- kernels for eight systems at once, each in a lane of a vector.
 *
 * Every number of a system becomes a group of QDOT_LANES doubles, lane l at [l]; a series is
 * such groups by order, coefficient k of lane l at [k QDOT_LANES + l]. All lanes carry out the
 * same operations, so an instruction on a vector serves all of them.
 *
 * All kernels exist three times, as in series.h: portable vectors of the compiler, AVX2 and
 * AVX-512 with fused multiplications; code of other floors is compiled three times in the
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

/* n series x_i, with coefficient k in the group x[(i stride + k) QDOT_LANES]. The derivatives of
 * the first `checked` are the series that follow: dx_i/dt = x_{i + checked}. */
typedef struct {
    size_t n, checked, stride;
    const double *x;
} qdot_batch_series;

/* The states y + carry of many systems side by side: [n] groups of numbers, one number for each system. */
typedef struct {
    double *y, *carry;
} qdot_batch_sum;

/* A polynomial at the end of a step: its derivatives there [n], its coefficients of order 1 [n],
 * the state [n]; the step in the old and in the new unit, a group each. */
typedef struct {
    const double *slope, *first, *next, *steps, *now;
    double share, rounding;
} qdot_batch_defect;

typedef struct {
    const char *name; /* kind of processor: "portable", "avx2", "avx512" */

    /* [n] for n = 0 ... QDOT_SERIES_MOST + 1: out = sum_{j=0..n-1} a[j] b[-j], groups; and
     * both sum a[j] b[-j] and sum a[j] c[-j]. An output may be an operand's newest. */
    qdot_batch_dot *dot[QDOT_SERIES_MOST + 2];
    qdot_batch_pair *pair[QDOT_SERIES_MOST + 2];

    /* log2 of the length of a step, in units of s, by orders from ... p of n series:
     *
     *     out = min_k (most_k - log2 max_i |x_ik| weight_i) inverse_k
     *
     * to 0.1, inverse_k = 1/k, and at most about 1000 inverse_p; INFINITY if all coefficients are
     * 0, NaN if one is not finite. n > 0, weight [n], out one group. */
    void (*log_steps)(const qdot_batch_series *series, int from, int p, const double *weight,
                      const double *inverse, const double *most, double *out);

    /* The tail of each series from order 2 on,
     *
     *     value[i] = sum_{k=2..p} x_k s^(k-1),   slope[i] = sum_{k=1..p} k x_k s^(k-1),
     *
     * slopes only for i >= `checked`. p >= 2; s is one group. */
    void (*tails)(const qdot_batch_series *series, int p, const double *s, double *value,
                  double *slope);

    /* Advance in twice the precision: to = from + s (x_1 + value) + s low, all [n]; low_i = unit
     * carry_{i + checked} for i < checked, else 0; unit is one group. */
    void (*advance)(const qdot_batch_series *series, const double *s, const double *unit,
                    const double *value, qdot_batch_sum from, qdot_batch_sum to);

    /* Sines and cosines of a group, each to 0.9 ulp. A lane beyond 1e5, or not finite, uses the C
     * library, which does not affect the others. */
    void (*sincos)(const double *x, double *sine, double *cosine);

    /* weights of components: out [n] = 1/max(1, |y|) */
    void (*weights)(size_t n, const double *y, double *out);

    /* Whether the derivatives of a polynomial satisfy the equations: for i >= `checked`, with
     * P = slope steps and f = x_1 now, steps and now one group,
     *
     *     |P - f| <= share size + rounding (|P| + |first steps| + size),
     *
     * size = max(1, |next|), and all x_1 finite. good, finite: a group of numbers, all bits
     * set or none. */
    void (*confirm)(const qdot_batch_series *series, const qdot_batch_defect *defect,
                    int64_t *good, int64_t *finite);
    /* copy from [n] to `to` in those lanes (systems) whose bits are set */
    void (*blend)(size_t n, const int64_t *set, const double *from, double *to);

    /* A [n x n] = L S L^T, S = 1 in the first `positive` rows and -1 in the others -> L below and
     * on the diagonal, with 1/L_ii in the place of L_ii. The first rows must be positive definite
     * and their Schur complement negative definite, by more than 2^-40 of what elimination takes
     * from a diagonal entry; else the lane gets NaN or infinities. */
    void (*factor)(size_t n, size_t positive, double *A);
    /* solve with the factors of `factor`: x [n] <- (L S L^T)^-1 x */
    void (*solve)(size_t n, size_t positive, const double *L, double *x);
    /* compute the inverse [n x n] of the matrix L S L^T, given by its factors */
    void (*invert)(size_t n, size_t positive, const double *L, double *inverse);
    /* inverse of A [2 x 2] by its cofactors; A[0][1] is not read; NaN in a lane in which A is not
     * positive definite. */
    void (*invert_two)(const double *A, double *inverse);
    /* multiply by a matrix: y [n] = A x */
    void (*multiply)(size_t n, const double *A, const double *x, double *y);
} qdot_batch_kernels;

/* The best kernels that this processor can run. */
const qdot_batch_kernels *qdot_batch_kernels_get(void);

/* Kind i of kernels among those that this processor can run, the portable one first; NULL past the last. */
const qdot_batch_kernels *qdot_batch_kernels_at(size_t i);

/* The index of the kernels that qdot_batch_kernels_get returns: the last available kind (num/kinds.h). */
size_t qdot_batch_kind(void);

#endif
