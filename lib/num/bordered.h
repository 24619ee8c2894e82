/* bordered.h -- inverse of a small mass matrix bordered by a few constraints.
 *
 *     K = [ M  A^T ]      M n x n positive definite, A m x n, its rows independent,
 *         [ A   0  ]      n + m at most QDOT_BORDERED_MOST
 *
 * by Gauss-Jordan elimination along the diagonal: the Schur complement of M is -A M^-1 A^T,
 * negative definite, so no pivoting is needed.
 *
 * Source  Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 14.4; Vanderbei,
 *         SIAM J. Optim. 5 (1995) 100 (quasidefinite matrices).
 * Tests   tests/num/test_saddle.c
 */
#ifndef QDOT_NUM_BORDERED_H
#define QDOT_NUM_BORDERED_H

#include <stdbool.h>
#include <stddef.h>

#define QDOT_BORDERED_MOST 8

/* Replace K, both triangles, 0 beyond its n + m columns, by its inverse. false, with K undefined,
 * if a pivot of M is not positive, or if the squared sine between a row of A and those before it,
 * in the metric of M^-1, is at most `least`. */
bool qdot_bordered_invert(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST],
                          double least);

/* Invert like qdot_bordered_invert, but for a diagonal M, in half the time. */
bool qdot_bordered_invert_diagonal(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST],
                                   double least);

#endif
