/* least-move.h -- the shortest vector that satisfies a few linear equations, in a diagonal
 * metric.
 *
 *     min  x^T D x / 2   where A x = c:   x = D^-1 A^T (A D^-1 A^T)^-1 c,
 *
 * A m x n with m at most QDOT_LEAST_MOVE_ROWS, D positive. The same as the saddle point
 * (num/saddle.h) with b = 0, by Cholesky's method on m x m.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., 5.6 (least norm).
 * Tests   tests/num/test_saddle.c
 */
#ifndef QDOT_NUM_LEAST_MOVE_H
#define QDOT_NUM_LEAST_MOVE_H

#include <stdbool.h>
#include <stddef.h>

#define QDOT_LEAST_MOVE_ROWS 4

typedef struct {
    size_t n, m;
    double L[QDOT_LEAST_MOVE_ROWS][QDOT_LEAST_MOVE_ROWS]; /* Cholesky factor of A D^-1 A^T; its diagonal holds the inverses */
    double *W; /* [m x n] the matrix A D^-1, owned by the caller */
} qdot_least_move;

/* Factor for A [m x n] and D [n], at D[i step]. false if the sine between a row and those before
 * it is below 1e-3, or D is not positive. */
bool qdot_least_move_factor(qdot_least_move *s, const double *A, const double *D,
                            size_t step);

/* Find the smallest x [n], measured by D, with A x = c [m]; c is overwritten. */
void qdot_least_move_solve(const qdot_least_move *s, double *c, double *x);

#endif
