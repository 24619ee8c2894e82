/* lu.h -- dense linear systems with row exchanges, real and complex.
 *
 *     P A = L U,   |L_ij| <= 1
 *
 * A complex matrix is two real ones, its parts, each row-major [n x n]. What is zero before the first
 * and behind the last entry of a row is not computed with: in the order of qdot_lu_order a matrix of
 * neighbours, as of a chain, costs a multiple of n.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed. (2013), 3.4.
 * Tests   tests/num/test_lu.c
 */
#ifndef QDOT_NUM_LU_H
#define QDOT_NUM_LU_H

#include <stdbool.h>
#include <stddef.h>

/* The index of the pivot row; the entries of this row are 0 except in columns from ... to - 1. */
typedef struct {
    size_t pivot, from, to;
} qdot_lu_row;

/* An order [n] out of the unknowns of a matrix of that pattern, symmetric, [n x n], in which its
 * entries are near the diagonal (Cuthill & McKee); scratch [n]. */
void qdot_lu_order(size_t n, const bool *pattern, size_t *order, size_t *scratch);

/* Factor A in place; rows [n] gets pivots and row ends. False, with A undefined, if a pivot is 0 or not finite. */
bool qdot_lu_factor(size_t n, double *A, qdot_lu_row *rows);

/* Solve A x = b with the factors of A; b [n] is replaced by x. */
void qdot_lu_solve(size_t n, const double *A, const qdot_lu_row *rows, double *b);

/* Factor, and solve, for complex matrices re + i im; the factors hold the inverses of the pivots. */
bool qdot_lu_factor_complex(size_t n, double *re, double *im, qdot_lu_row *rows);
void qdot_lu_solve_complex(size_t n, const double *re, const double *im,
                           const qdot_lu_row *rows, double *b_re, double *b_im);

#endif
