/* bordered.h -- the inverse of a small matrix bordered by the rows of a few constraints.
 *
 *     K = [ M  A^T ]      M n x n positive definite, A m x n, its rows independent,
 *         [ A   0  ]      n + m at most QDOT_BORDERED_MOST
 *
 * by Gauss-Jordan's method along the diagonal: what M leaves of the lower block is
 * -A M^-1 A^T, negative definite, so that no pivot is looked for.
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

/* K, both triangles, what is beyond its n + m columns being 0, becomes its inverse. false
 * where a pivot of M is not positive, or a row of A has no more than the squared sine `least`
 * left beyond those before it, in the metric of M^-1: then K holds nothing. */
bool qdot_bordered_invert(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST],
                          double least);

/* The same of a diagonal M, in half the time. */
bool qdot_bordered_invert_diagonal(size_t n, size_t m, double (*K)[QDOT_BORDERED_MOST],
                                   double least);

#endif
