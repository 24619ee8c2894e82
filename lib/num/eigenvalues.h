/* eigenvalues.h -- eigenvalues of a real matrix whose entries have errors.
 *
 *     d lambda = |w E v| / |w v|     for the right and left vectors v, w of lambda, |dA| <= E
 *
 * and, with e_kj = |w_k| E |v_j|, for each that is not far from it sqrt(e_kj e_jk), less where it is farther off. Where
 * two lie together by nearly one vector this is far too much. In the plane of both vectors, orthonormal q_1 = v_k and
 * q_2 with the dual l_1, l_2, A is [lambda_k c; 0 lambda_j], so
 *
 *     error = max(e_11, e_22) + 2 sqrt(e_21 (|c| + e_12)),     e_ij = |l_i| E |q_j|,   c = q_1 A q_2
 *
 * (2 as |dA| may be more than E). The lesser is taken.
 *
 * Those of a product A_(K-1) ... A_0, each with errors, are the K-th powers of those of the matrix of K x K blocks with A_k
 * in row k + 1, column k (row 0 for the last): each comes K times. A product loses those that are less than its largest
 * entry by 1e16; these have the errors of what its factors do to their own vectors.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., 7.2.2; Wilkinson, The Algebraic Eigenvalue Problem, 2.22;
 *         GSL (QR with double shifts); Watkins, SIAM
 *         Review 47 (2005) 3 (products).
 * Tests   tests/num/test_eigenvalues.c
 */
#ifndef QDOT_NUM_EIGENVALUES_H
#define QDOT_NUM_EIGENVALUES_H

#include <stddef.h>

#include "base/status.h"

/* The eigenvalues of A [n x n] with errors E [n x n], by rows; re, im, error [n] sorted by
 * _arrange. QDOT_EFAILED, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_eigenvalues(size_t n, const double *A, const double *E,
                                             double *re, double *im, double *error);

/* Find the eigenvalues of a product of K matrices A [K x n x n], of which the first acts first, with errors E. */
QDOT_MUST_CHECK qdot_status qdot_eigenvalues_of_product(size_t K, size_t n, const double *A, const double *E,
                                                        double *re, double *im, double *error);

/* Put re, im, error [n] in descending order of modulus. Those whose moduli are the same within their errors stand by
 * descending real part, and a pair with its positive imaginary part first, so that rounding does not decide on the order. */
void qdot_eigenvalues_arrange(size_t n, double *re, double *im, double *error);

#endif
