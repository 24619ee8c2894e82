/* residual-tree.h -- d'Alembert's residual as bodies that hang on each other.
 *
 * Functions that a weight couples, or that move with one coordinate, are components of a
 * node; nodes hang on each other as their functions do (`parent` of residual.h). Where a
 * coordinate's slopes are on one node each, and no node hangs on two, M is eliminated along
 * that tree (num/articulated.h).
 *
 * Tests  tests/sim/form/test_residual-sweeps.c
 */
#ifndef QDOT_SIM_RESIDUAL_TREE_H
#define QDOT_SIM_RESIDUAL_TREE_H

#include "num/articulated.h"
#include "sim/form/residual.h"

typedef struct {
    size_t nodes, m, c; /* number of nodes; largest number of components (functions) and of coordinates of a node */
    uint32_t *function;     /* [nodes x m] function of each component; UINT32_MAX: none */
    uint32_t *coordinate;   /* [nodes x c] the node's coordinates; UINT32_MAX: fewer than c */
    uint32_t *slope; /* [nodes x c x m] output of `places` that is the derivative by a coordinate; UINT32_MAX: 0 */
    uint32_t *node, *place; /* [functions] node and component to which a function belongs */
    uint32_t *parent;       /* [nodes x m] component of the parent node, as in num/articulated.h */
    uint8_t *unknowns;      /* [nodes] number of coordinates of the node */
} qdot_residual_tree;

/* Find the tree of a residual with n coordinates. *tree NULL: its functions do not form a tree.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_residual_tree_new(const qdot_residual *r, size_t n,
                                                   qdot_residual_tree **tree);
void qdot_residual_tree_free(qdot_residual_tree *tree);

/* Make the linear system of the tree, with the weights w [n_weights]. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_residual_tree_system(const qdot_residual_tree *tree,
                                                      const qdot_residual *r,
                                                      const double *w,
                                                      qdot_articulated **system);

#endif
