/* eigenvalues.h -- eigenvalues of a real matrix whose entries have errors.
 *
 *     d lambda = |w E v| / |w v|     for the right and left vectors v, w of lambda, |dA| <= E
 *
 * Where several lie together this first order of their distance is about that distance itself.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., 7.2.2; GSL (QR with double shifts).
 * Tests   tests/num/test_eigenvalues.c
 */
#ifndef QDOT_NUM_EIGENVALUES_H
#define QDOT_NUM_EIGENVALUES_H

#include <stddef.h>

#include "base/status.h"

/* A and E [n x n] row by row; re, im, error [n] in descending order of modulus, a pair with its positive
 * imaginary part first. Errors: QDOT_EFAILED, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_eigenvalues(size_t n, const double *A, const double *E,
                                             double *re, double *im, double *error);

#endif
