/* balance.h -- a diagonal matrix D of powers of 2 so that rows and columns of D^-1 A D are alike in size.
 *
 *     sum_j |a_ij| d_j/d_i = sum_j |a_ji| d_i/d_j, within a factor of about 2, without the diagonal
 *
 * For a matrix of slopes dz_i/dz_j, D are units of z by which the slopes are alike; eigenvalues do not change.
 *
 * Source  Osborne, J. ACM 7 (1960) 338; Parlett & Reinsch, Numer. Math. 13 (1969) 293
 * Tests   tests/num/test_balance.c
 */
#ifndef QDOT_NUM_BALANCE_H
#define QDOT_NUM_BALANCE_H

#include <stddef.h>

/* Scale factors d [n] for |A| [n x n], row by row; 1 for a row or column that is 0 off the
 * diagonal, or not finite. */
void qdot_balance(size_t n, const double *A, double *d);

#endif
