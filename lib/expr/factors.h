/* factors.h -- how square matrices were made of others: A B, A^T.
 *
 * The entries of a product of N matrices are polynomials of degree N, from which nothing that holds for the factors, and so
 * for the product, is found again: of rotations, that it is one. So the pool notes of each square matrix that a multiplication
 * or transposition makes what it was first made of, if that is older.
 *
 * Tests  tests/expr/test_tensor.c
 */
#ifndef QDOT_EXPR_FACTORS_H
#define QDOT_EXPR_FACTORS_H

#include "expr/id.h"

/* What a matrix was made of, matrices of smaller ids: *a *b, or where *b is nil the transpose of *a. False: unknown; both nil. */
bool qdot_factors_of(const qdot_pool *pool, qdot_expr matrix, qdot_expr *a, qdot_expr *b);

#endif
