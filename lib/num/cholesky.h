/* cholesky.h -- symmetric positive definite systems, block by block.
 *
 *     A = L L^T,   A x = b by L z = b, L^T x = z
 *
 * A is n x n, row-major. Its lower triangle is read and overwritten by L; the upper one
 * is scratch. With a structure only the entries inside the blocks are touched: a diagonal
 * matrix costs n square roots, k blocks of n/k cost 1/k^2 of the full factorisation.
 *
 * A pivot is the remainder of a diagonal entry after the eliminations before it:
 *
 *     d_k = a_kk - sum_j<k l_kj^2 = v^T A v,   v = (-A_11^-1 a_1k, 1).
 *
 * Rounding amounts to a change of A by at most about k 2^-52 sqrt(a_ii a_jj) in each
 * entry, so d_k is known to k 2^-52 (sum_i |v_i| sqrt(a_ii))^2, and A counts as singular
 * when
 *
 *     d_k <= 4 (k + 1) 2^-52 (sum_i |v_i| sqrt(a_ii))^2:
 *
 * that is if a change within rounding makes it singular. v is formed only if a pivot so far has
 * lost four digits. The test does not depend on the units of the unknowns (D A D is
 * singular if A is, D diagonal and positive).
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., alg. 4.2.1; Higham, Accuracy
 *         and Stability of Numerical Algorithms, 2nd ed., th. 10.5 (the size of the
 *         rounding).
 * Tests   tests/num/test_cholesky.c
 */
#ifndef QDOT_NUM_CHOLESKY_H
#define QDOT_NUM_CHOLESKY_H

#include "base/status.h"
#include "num/structure.h"

/* Factor `a` in place.
 *   s       its blocks; borrowed; NULL: full
 *   failed  out, may be NULL: the row whose pivot vanished (the caller knows its name)
 * Returns QDOT_OK; QDOT_ESINGULAR, `a` then half overwritten: A is singular, not positive
 * definite, or holds a NaN. Nothing is allocated. */
QDOT_MUST_CHECK qdot_status qdot_cholesky_factor(double *a, size_t n,
                                                 const qdot_structure *s, size_t *failed);

/* Solve a linear system with a matrix factored for the same structure; b [n] is overwritten by the solution x. */
void qdot_cholesky_solve(const double *a, size_t n, const qdot_structure *s, double *b);

#endif
