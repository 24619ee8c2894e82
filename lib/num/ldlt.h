/* ldlt.h -- symmetric indefinite systems by Bunch-Kaufman pivoting.
 *
 *     P S A S P^T = L D L^T
 *
 * L unit lower triangular, D of 1 x 1 and 2 x 2 blocks, P a permutation, S a diagonal of
 * powers of two that brings the largest entry of each row near 1 (so that "singular" does
 * not depend on the units of the unknowns, and nothing is rounded by the scaling).
 * For the matrix d2L/dq'dq' of a stated Lagrangian, and for saddle points [M A^T; A 0].
 *
 * A counts as singular when the largest entry left in a column, its diagonal included, is
 * at most 16 n 2^-52 (of a scaled matrix whose entries are about 1).
 *
 * Source  Bunch & Kaufman, Math. Comp. 31 (1977) 163, algorithm A; Ruiz, RAL-TR-2001-034
 *         (the scaling). Tests: tests/num/test_ldlt.c.
 */
#ifndef QDOT_NUM_LDLT_H
#define QDOT_NUM_LDLT_H

#include <stddef.h>

#include "base/status.h"

/* Work space for factoring matrices of one size; nothing is allocated after qdot_ldlt_init. */
typedef struct {
    size_t n;
    size_t *order; /* [n] the unknown at each position after the interchanges */
    bool *pair;    /* [n] true at the first row of a 2 x 2 block */
    double *scale; /* [n] scale factors S of the unknowns */
    double *work;  /* [n] scratch */
} qdot_ldlt;

/* Allocate work space for n unknowns. Errors: QDOT_ENOMEM, with `f` cleared. */
QDOT_MUST_CHECK qdot_status qdot_ldlt_init(qdot_ldlt *f, size_t n);
void qdot_ldlt_clear(qdot_ldlt *f);

/* Factor `a` (n x n row-major, lower triangle read) in place: L below the diagonal, D on
 * it and, for a 2 x 2 block, just below it.
 *   failed  out, may be NULL: the unknown whose column vanished
 * Returns QDOT_OK; QDOT_ESINGULAR, `a` then half overwritten: singular, or not finite. */
QDOT_MUST_CHECK qdot_status qdot_ldlt_factor(qdot_ldlt *f, double *a, size_t *failed);

/* Solve a linear system with a factored matrix `a`; b [n] is overwritten by the solution x. */
void qdot_ldlt_solve(const qdot_ldlt *f, const double *a, double *b);

#endif
