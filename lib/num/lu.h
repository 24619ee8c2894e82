/* lu.h -- dense linear systems with row exchanges, real and complex.
 *
 *     P A = L U,   |L_ij| <= 1
 *
 * A complex matrix is two real ones, its parts; each entry of an array is of row-major [n x n].
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed. (2013), 3.4.
 * Tests   tests/num/test_lu.c
 */
#ifndef QDOT_NUM_LU_H
#define QDOT_NUM_LU_H

#include <stdbool.h>
#include <stddef.h>

/* Factor A in place; pivot [n] out. False, with A undefined, if a pivot is 0 or not finite. */
bool qdot_lu_factor(size_t n, double *A, size_t *pivot);

/* Solve with it; b [n] is the right-hand side, then the solution. */
void qdot_lu_solve(size_t n, const double *A, const size_t *pivot, double *b);

/* The same for re + i im. */
bool qdot_lu_factor_complex(size_t n, double *re, double *im, size_t *pivot);
void qdot_lu_solve_complex(size_t n, const double *re, const double *im,
                           const size_t *pivot, double *b_re, double *b_im);

#endif
