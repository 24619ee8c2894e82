/* taylor-wide.h -- a Taylor program by vectors of like steps: eight at once.
 *
 * Steps of the same recurrence that wait for no other of them - the sines and cosines of a
 * chain's angles - are lanes of a group. Coefficients are kept by order, then lane, so that
 * an order of a product is a sum over full vectors, of which none is ever added up:
 *
 *     c_k[lanes] = sum_{j=0..k} a_j[lanes] b_{k-j}[lanes].
 *
 * Operands that do not lie side by side as their group asks are copied there once an order.
 * The program is one whose first inputs are corrected: an order is
 * evaluated with their newest coefficients at 0, and brought up to date when they are known.
 *
 * Tests  tests/series/test_taylor-wide.c
 */
#ifndef QDOT_SERIES_TAYLOR_WIDE_H
#define QDOT_SERIES_TAYLOR_WIDE_H

#include "series/taylor.h"

typedef struct qdot_taylor_wide qdot_taylor_wide;

enum { QDOT_WIDE_LANES = 8 };

/* The rows of a step as lanes: order 0 of each. A row that the step does not have is any of the others. */
typedef struct {
    double *to, *second, *third, *d;
    const double *x, *y, *z;
} qdot_wide_rows;

/* The rows of eight lanes in the sum over j = 0 ... n - 1 of x[j x_stride] y[-j y_stride]. */
typedef struct {
    const double *x, *y;
} qdot_wide_pair;

/* Of a program, borrowed, whose inputs from n on have no coefficients beyond order 1 and are
 * not corrected. lane [n]: which of `lanes` lanes those before are, in what order steps alike
 * follow; NULL: the first n, in their order. *wide NULL: too few steps are alike. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_wide_new(const qdot_taylor *t, size_t n,
                                                 const size_t *lane, size_t lanes,
                                                 qdot_taylor_wide **wide);
void qdot_taylor_wide_free(qdot_taylor_wide *wide);

/* The number of lanes, the same for every order, an odd multiple of eight; the next function: address of order k. */
size_t qdot_taylor_wide_width(const qdot_taylor_wide *wide);
double *qdot_taylor_wide_at(const qdot_taylor_wide *wide, int k);
/* The index of the lane in which the coefficients of a row of the program are stored. */
size_t qdot_taylor_wide_lane(const qdot_taylor_wide *wide, const double *row);
/* Where the rows of `count` lanes lie side by side from order to order, from a multiple of
 * eight on: as they do, or copied; SIZE_MAX as a lane: 0. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_wide_align(qdot_taylor_wide *wide, size_t count,
                                                   const size_t *lanes, size_t *at);

/* Allocate the arrays, once all operands have been placed side by side. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_wide_settle(qdot_taylor_wide *wide);

/* Order 0, from the program's. Order k > 0 with coefficients k of the first n inputs at 0;
 * what changes when they are newest [n], or [lanes], over `divisor` (exactly in low orders). */
void qdot_taylor_wide_begin(qdot_taylor_wide *wide, const qdot_taylor *t);
void qdot_taylor_wide_order(qdot_taylor_wide *wide, int k);
void qdot_taylor_wide_correct(qdot_taylor_wide *wide, int k, const double *newest,
                              double divisor);
/* Coefficients 2 ... last of the first n inputs into q [n x stride] by rows, and k per_unit
 * times them, k that of each, into v [n x stride] at k - 1. Up to seven more are written. */
void qdot_taylor_wide_rows(const qdot_taylor_wide *wide, int last, double per_unit,
                           double *q, double *v, size_t stride);

/* A sum of products of n orders, for pairs of groups; strides in doubles. */
typedef struct {
    size_t pairs;
    const qdot_wide_pair *pair;
    size_t n, x_stride, y_stride;
} qdot_wide_sum;

/* Set out [8] to scale times (from [8] minus the sum of products); from NULL counts as 0. */
void qdot_taylor_wide_rest(const qdot_taylor_wide *wide, const qdot_wide_sum *sum,
                           double scale, const double *from, double *out);

/* The number of vector operations in convolution sums at one order; qdot_taylor_wide_groups: number of groups. */
double qdot_taylor_wide_convolutions(const qdot_taylor_wide *wide);
size_t qdot_taylor_wide_groups(const qdot_taylor_wide *wide);

#endif
