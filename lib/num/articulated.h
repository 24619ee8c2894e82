/* articulated.h -- symmetric positive systems along a tree, by elimination from the leaves.
 *
 * A node n has m components and c unknowns q_n, and hangs on a parent:
 *
 *     x_n = E_n x_parent + d_n + S_n q_n
 *     F_n = W_n x_n + sum over children of E^T F
 *     S_n^T F_n = r_n
 *
 * (a chain of bodies: places, forces, coordinates, given d and r). E_n picks components of the
 * parent. The matrix of the q's, S^T W S summed along the tree, is full, and never formed:
 * what hangs on a node acts on it as F = I x + Z, where
 *
 *     I_0 = W + sum E^T I E,  H = (S^T I_0 S)^-1,  B = I_0 S H,  A = 1 - B S^T,
 *     I = A I_0 A^T,          passed on:  A Z + I d + B r,
 *     q = H (r - S^T Z) - B^T (E x_parent + d).
 *
 * I, A, B, H are found once, from the leaves to the roots: work N. A solution goes up with Z
 * and down with x. A tree that is one path is cut into eight pieces, which are the lanes of
 * vectors: the products of the A along them are made with the factors, so that a sweep of N
 * nodes waits for N/8 products and three more between the pieces; links in a plane hand on
 * numbers (articulated-plane.def). Other trees go node by node.
 *
 * Arrays hold components one after another, slots (places of nodes in vectors) within each.
 *
 * Source  Featherstone, Rigid Body Dynamics Algorithms (2008), ch. 7 (articulated bodies);
 *         Joseph's form of I as in filters (Bucy & Joseph 1968); Kogge & Stone, IEEE Trans.
 *         Comput. 22 (1973) 786 (three products for eight pieces).
 * Tests   tests/num/test_articulated.c: against Cholesky's method
 */
#ifndef QDOT_NUM_ARTICULATED_H
#define QDOT_NUM_ARTICULATED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

enum {
    QDOT_ARTICULATED_COMPONENTS = 6, /* of a node, at most */
    QDOT_ARTICULATED_UNKNOWNS = 3
};

#define QDOT_ARTICULATED_NONE UINT32_MAX

typedef struct {
    size_t nodes, m, c;
    /* [nodes x m] component of the parent, as node m + component, that one is measured
     * from; _NONE: from nowhere. One parent a node, before it. */
    const uint32_t *parent;
    const double *weight;    /* [nodes x m x m] W, symmetric */
    const uint8_t *unknowns; /* [nodes] <= c: the first */
} qdot_articulated_tree;

typedef struct qdot_articulated qdot_articulated;

/* Of a tree, copied. Errors: QDOT_EINVAL: more components, unknowns than there may be, or no
 * tree; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_articulated_new(const qdot_articulated_tree *tree,
                                                 qdot_articulated **articulated);
void qdot_articulated_free(qdot_articulated *a);

/* Slots of an array, a multiple of eight; that of a node, the first ones; whether the tree is
 * one path, taken by vectors. */
size_t qdot_articulated_slots(const qdot_articulated *a);
size_t qdot_articulated_slot(const qdot_articulated *a, size_t node);
bool qdot_articulated_is_path(const qdot_articulated *a);

/* S, arrays [c x m] of slots, at S[r m + component]. *lost: the least pivot over its diagonal
 * entry of the full matrix. false: the pivot of *node, *unknown is not positive. */
QDOT_MUST_CHECK bool qdot_articulated_factor(qdot_articulated *a, const double *const *S,
                                             double *lost, size_t *node, size_t *unknown);

/* One system of equations: S as it was when factored; d times `factor` and r on its right side; q
 * and F its solution. Arrays of slots. */
typedef struct {
    const double *const *S, *const *d, *const *r; /* [c m], [m], [c] */
    double factor;
    double *const *q, *const *F; /* [c], [m] */
} qdot_articulated_equations;

/* Slots that are no node's must hold numbers. */
void qdot_articulated_solve(qdot_articulated *a, const qdot_articulated_equations *equations);

#endif
