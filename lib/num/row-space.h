/* row-space.h -- the independent rows of a matrix, and shortest solutions.
 *
 *     A x = b,   A m x n of any rank r:   rows taken by pivots, A_r = L (Q^T)_r,
 *     x = Q_r L^-1 b_r,                   the solution of these r rows with the least |x|
 *
 * Householder reflections from the right; each row is first scaled to length 1, so that the rank
 * depends on the angles between rows only, not on the units of the equations. A row counts as
 * dependent if at most `tol` of its length is outside the span of those before it.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., sec. 5.4 and 5.5.
 * Tests   tests/num/test_row-space.c
 */
#ifndef QDOT_NUM_ROW_SPACE_H
#define QDOT_NUM_ROW_SPACE_H

#include <stddef.h>

#include "base/status.h"

/* Work space for matrices of at most m x n; nothing is allocated after qdot_row_space_init. */
typedef struct {
    size_t m, n, rank;
    size_t *order; /* [m] rows in the order in which they were pivots: the first `rank` are independent */
    double *rows;  /* [m x n] L left of its diagonal, Householder vectors right of it */
    double *diagonal; /* [m] the diagonal of L, by row */
    double *size;  /* [m] length of each row of A */
    double *beta;  /* [m] factors of the Householder reflections */
    double *z;     /* [m + n] scratch */
} qdot_row_space;

/* Allocate work space for matrices of at most m x n. Errors: QDOT_ENOMEM, with *f cleared. */
QDOT_MUST_CHECK qdot_status qdot_row_space_init(qdot_row_space *f, size_t m, size_t n);
void qdot_row_space_clear(qdot_row_space *f);

/* Factor A [m * n], row-major, unchanged. in_order: a row is compared only with those above it,
 * so that of two equal ones the later is dependent; else the row with the longest remainder is
 * taken first, which is more accurate. */
void qdot_row_space_factor(qdot_row_space *f, const double *A, double tol, bool in_order);

/* x [n]: the shortest with A x = b [m] in the independent rows. lambda [m] (NULL: not
 * wanted): x = A^T lambda, 0 at dependent rows. */
void qdot_row_space_shortest(qdot_row_space *f, const double *b, double *x,
                             double *lambda);

/* Remove from x [n] its component in the row space of A: the rest is tangent to A x = const. */
void qdot_row_space_tangent(qdot_row_space *f, double *x);

#endif
