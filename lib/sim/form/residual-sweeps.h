/* residual-sweeps.h -- orders of d'Alembert's residual by elimination along its tree.
 *
 * With what q has at order k + 2 taken as 0, d'' of order k is known, and
 *
 *     J_0^T F_k = Q_k - sum_{j=1..k} J_j^T F_{k-j},   F = W x'' summed up the tree,
 *
 * is the system of num/articulated.h: one sweep up the tree and one down it give q'' and F of
 * order k together. Neither M nor W is formed, and an order is work N. Slopes, differences
 * and forces are vectors of eight nodes (series/taylor-wide.h).
 *
 * Tests  tests/sim/form/test_residual-sweeps.c
 */
#ifndef QDOT_SIM_RESIDUAL_SWEEPS_H
#define QDOT_SIM_RESIDUAL_SWEEPS_H

#include "sim/form/residual-tree.h"
#include "series/taylor.h"

typedef struct qdot_residual_sweeps qdot_residual_sweeps;

/* Of a residual with n coordinates and its program, both borrowed, w [n_weights] its
 * weights. *tree NULL: it has no tree, or its program no vectors. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_residual_sweeps_new(const qdot_residual *r, size_t n,
                                                     const qdot_taylor *places,
                                                     const double *w,
                                                     qdot_residual_sweeps **tree);
void qdot_residual_sweeps_free(qdot_residual_sweeps *tree);

/* Orders 0 and 1 of the program, whose order 0 is there, first [n]: q of order 1; factors.
 * *lost as qdot_articulated_factor; false: no positive pivot. */
QDOT_MUST_CHECK bool qdot_residual_sweeps_begin(qdot_residual_sweeps *tree,
                                                const qdot_taylor *places,
                                                const double *first, double *lost);

/* Coefficients m >= 2 of q: `scale` times what the program applies, and of order m - 2 more
 * [n], already times it (NULL: nothing). Then those of orders 2 ... last where they belong,
 * as qdot_taylor_wide_rows has it. */
void qdot_residual_sweeps_order(qdot_residual_sweeps *tree, int m, double scale,
                                const double *more);
void qdot_residual_sweeps_rows(const qdot_residual_sweeps *tree, int last,
                               double per_unit, double *q, double *v, size_t stride);

/* Count operations like qdot_residual_vectors_count; `products` are those of sweeps along the tree. */
void qdot_residual_sweeps_count(const qdot_residual_sweeps *tree, double *convolutions,
                                double *products, double *begun);
size_t qdot_residual_sweeps_nodes(const qdot_residual_sweeps *tree);
bool qdot_residual_sweeps_is_path(const qdot_residual_sweeps *tree);

#endif
