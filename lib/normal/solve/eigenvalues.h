/* eigenvalues.h -- the eigenvalues of a matrix of constants, enclosed in balls.
 *
 * Those of rational numbers are the roots of the characteristic polynomial, isolated after its multiple factors are divided out. Else
 * approximate eigenvalues and vectors by QR are proved by the enclosures of Arb, also where some coincide; the precision
 * is raised until they are known to the last bit of a double.
 *
 * Source  Miyajima, "Fast enclosure for all eigenvalues in generalized eigenvalue problems", J. Comput. Appl. Math. 233
 *         (2010) 2994; Rump & Graillat, Numer. Algorithms 54 (2010) 359 (FLINT's acb_mat_eig_multiple).
 * Tests   tests/normal/solve/test_eigenvalues.c
 */
#ifndef QDOT_NORMAL_EIGENVALUES_H
#define QDOT_NORMAL_EIGENVALUES_H

#include <stddef.h>

#include "expr/id.h"

/* The eigenvalues re + i im [n] of A [n x n], constants, by rows; the distance of each to the true one is at most error
 * [n]; im is 0 where the enclosure holds a real number. Sorted by real part, then by imaginary part. QDOT_EDOMAIN: an
 * entry has no value; QDOT_EFAILED: not enclosed with the digits allowed. */
QDOT_MUST_CHECK qdot_status qdot_eigenvalues_of_constants(qdot_pool *pool, size_t n, const qdot_expr *A, double *re,
                                                          double *im, double *error);

#endif
