/* articulated.h -- symmetric positive systems along a tree, by elimination from the leaves.
 *
 * A node n has m components and c unknowns q_n, and hangs on a parent:
 *
 *     x_n = E_n x_parent + d_n + S_n q_n
 *     F_n = W_n x_n + sum over children of E^T F
 *     S_n^T F_n = r_n
 *
 * (a chain of bodies: x are positions, F forces, q coordinates; d and r are given). E_n selects
 * components of the parent. The matrix of the q's, S^T W S summed along the tree, is full, and
 * never formed: the subtree of a node exerts F = I x + Z on it, where
 *
 *     I_0 = W + sum E^T I E,  H = (S^T I_0 S)^-1,  B = I_0 S H,  A = 1 - B S^T,
 *     I = A I_0 A^T,          passed on:  A Z + I d + B r,
 *     q = H (r - S^T Z) - B^T (E x_parent + d).
 *
 * I, A, B, H are computed once, from the leaves to the roots: work N. A solution is a sweep
 * towards the roots for Z and one back for x. A tree that is one path is cut into eight pieces,
 * the lanes of vectors: the products of the A along each piece are computed with the factors, so
 * that a sweep of N nodes takes N/8 products one after another and three more between the pieces.
 * Up to eight links in a plane pass on single numbers (articulated-plane.def). Other trees are treated node
 * by node.
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
    QDOT_ARTICULATED_COMPONENTS = 6, /* largest m: components of a node */
    QDOT_ARTICULATED_UNKNOWNS = 3
};

#define QDOT_ARTICULATED_NONE UINT32_MAX

typedef struct {
    size_t nodes, m, c;
    /* [nodes x m] index (node m + component) of the parent's component to which a component is
     * relative; _NONE: to nothing. Each node has one parent, which precedes it. */
    const uint32_t *parent;
    const double *weight;    /* [nodes x m x m] weights W of the nodes, symmetric */
    const uint8_t *unknowns; /* [nodes] number of unknowns of each node, <= c */
} qdot_articulated_tree;

typedef struct qdot_articulated qdot_articulated;

/* For a tree, copied. Errors: QDOT_EINVAL: too many components or unknowns, or not a tree;
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_articulated_new(const qdot_articulated_tree *tree,
                                                 qdot_articulated **articulated);
void qdot_articulated_free(qdot_articulated *a);

/* The number of slots of an array, a multiple of eight; the slot of a node; whether the tree is
 * one path, treated by vectors. */
size_t qdot_articulated_slots(const qdot_articulated *a);
size_t qdot_articulated_slot(const qdot_articulated *a, size_t node);
bool qdot_articulated_is_path(const qdot_articulated *a);

/* Factor for S, arrays [c x m] of slots, at S[r m + component]. *lost: the least ratio of a pivot
 * to its diagonal entry of the full matrix. false: the pivot of *node, *unknown is not positive.
 *  */
QDOT_MUST_CHECK bool qdot_articulated_factor(qdot_articulated *a, const double *const *S,
                                             double *lost, size_t *node, size_t *unknown);

/* One system of equations: S as when it was factored; right-hand sides d times `factor`, and r;
 * solution q and F. Arrays of slots. */
typedef struct {
    const double *const *S, *const *d, *const *r; /* arrays of one value for each node: S [c m], d [m], r [c] */
    double factor;
    double *const *q, *const *F; /* output, one value for each node: q [c], F [m] */
} qdot_articulated_equations;

/* Solve the linear system along the tree. Slots without a node must contain finite numbers. */
void qdot_articulated_solve(qdot_articulated *a, const qdot_articulated_equations *equations);

#endif
