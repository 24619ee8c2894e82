/* shifted-tree.h -- orders of d'Alembert's residual by elimination along its tree.
 *
 * With what q has at order k + 2 taken as 0, d'' of order k is known, and
 *
 *     J_0^T F_k = Q_k - sum_{j=1..k} J_j^T F_{k-j},   F = W x'' summed up the tree,
 *
 * is the system of num/articulated.h: one sweep up the tree and one down it give q'' and F of
 * order k together. Neither M nor W is formed, and an order is work N. Slopes, differences
 * and forces are vectors of eight nodes (series/taylor-wide.h).
 *
 * Tests  tests/sim/test_shifted-tree.c
 */
#ifndef QDOT_SIM_SHIFTED_TREE_H
#define QDOT_SIM_SHIFTED_TREE_H

#include "sim/form/residual-tree.h"
#include "series/taylor.h"

typedef struct qdot_shifted_tree qdot_shifted_tree;

/* Of a residual with n coordinates and its program, both borrowed, w [n_weights] its
 * weights. *tree NULL: it has no tree, or its program no vectors. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_shifted_tree_new(const qdot_residual *r, size_t n,
                                                  const qdot_taylor *places,
                                                  const double *w,
                                                  qdot_shifted_tree **tree);
void qdot_shifted_tree_free(qdot_shifted_tree *tree);

/* Orders 0 and 1 of the program, whose order 0 is there, first [n]: q of order 1; factors.
 * *lost as qdot_articulated_factor; false: no positive pivot. */
QDOT_MUST_CHECK bool qdot_shifted_tree_begin(qdot_shifted_tree *tree,
                                             const qdot_taylor *places,
                                             const double *first, double *lost);

/* Coefficients m >= 2 of q: `scale` times what the program applies, and of order m - 2 more
 * [n], already times it (NULL: nothing). Then those of orders 2 ... last where they belong,
 * as qdot_taylor_wide_rows has it. */
void qdot_shifted_tree_order(qdot_shifted_tree *tree, int m, double scale,
                             const double *more);
void qdot_shifted_tree_rows(const qdot_shifted_tree *tree, int last, double per_unit,
                            double *q, double *v, size_t stride);

/* As qdot_shifted_wide_count; `products` of the sweeps. */
void qdot_shifted_tree_count(const qdot_shifted_tree *tree, double *convolutions,
                             double *products, double *begun);
size_t qdot_shifted_tree_nodes(const qdot_shifted_tree *tree);
bool qdot_shifted_tree_is_path(const qdot_shifted_tree *tree);

#endif
