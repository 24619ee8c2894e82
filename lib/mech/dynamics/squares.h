/* squares.h -- quadratic forms as sums of squares:
 *
 *     1/2 v.A v = 1/2 sum D_i (v_i + sum l_ij v_j)^2
 *
 * as a book prints the top: 1/2 A (theta'^2 + sin(theta)^2 phi'^2) + 1/2 C (psi' + cos(theta) phi')^2.
 * Squares whose D_i differ only in factors with coordinates are grouped.
 */
#ifndef QDOT_MECH_SQUARES_H
#define QDOT_MECH_SQUARES_H

#include "mech/scene/scene.h"

typedef struct {
    qdot_expr key, sum; /* a summand 1/2 key sum: `sum` is one or more squares, the key contains no coordinate */
} qdot_square;

/* A sum of squares being built; cleared by qdot_squares_clear. */
typedef struct {
    qdot_scene *s; /* the scene, borrowed */
    qdot_vec(qdot_square) at;
    qdot_expr rest; /* the terms that are not squares */
} qdot_squares;

void qdot_squares_begin(qdot_squares *q, qdot_scene *s);
void qdot_squares_clear(qdot_squares *q);

/* Add the square 1/2 D u^2 to the sum of squares. */
QDOT_MUST_CHECK qdot_status qdot_squares_add(qdot_squares *q, qdot_expr D, qdot_expr u);

/* Add 1/2 v.A v, A [n*n] symmetric, 2 <= n <= 3, as squares whose D contain no sum with
 * coordinates; *done false, and nothing added, if there are none. */
QDOT_MUST_CHECK qdot_status qdot_squares_complete(qdot_squares *q, size_t n,
                                                  const qdot_expr *A, const qdot_expr *v,
                                                  bool *done);

/* Whether a diagonal entry of A [n*n] contains a sum with coordinates, so that squares may be
 * shorter. */
bool qdot_squares_worth(const qdot_scene *s, size_t n, const qdot_expr *A);

/* Find the blocks of A [n*n]: block[i] is the smallest row coupled to row i, directly or indirectly. */
void qdot_squares_blocks(size_t n, const qdot_expr *A, size_t *block);

/* The sum of all squares added so far. */
qdot_expr qdot_squares_sum(const qdot_squares *q);

#endif
