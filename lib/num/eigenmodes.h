/* eigenmodes.h -- a vector by the eigenvectors of a real matrix.
 *
 *     A v_k = lambda_k v_k,   f = sum_k c_k v_k
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., 7.4; GSL (QR with double shifts)
 * Tests   tests/num/test_eigenmodes.c
 */
#ifndef QDOT_NUM_EIGENMODES_H
#define QDOT_NUM_EIGENMODES_H

#include <complex.h>
#include <stddef.h>

#include "base/status.h"

/* A [n x n row-major], f [n]; lambda [n], v [n x n], the k-th in row k, c [n]. Errors: QDOT_EFAILED where they are
 * not found or the vectors do not span the space, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_eigenmodes(size_t n, const double *A, const double *f,
                                            double complex *lambda, double complex *v,
                                            double complex *c);

#endif
