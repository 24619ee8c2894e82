/* sparse.h -- sparse symmetric systems that are positive definite in some unknowns and, after
 * these are eliminated, negative definite in the others.
 *
 *     K = L D L^T,   D > 0 for unknowns below `positive`, D < 0 beyond
 *
 * such as [M A^T; A 0] with M positive definite and the rows of A independent. The order of
 * elimination is found once, from the pattern: always the unknown with the fewest neighbours, one
 * beyond `positive` only after all its positive neighbours. There is no pivoting: the ratio of an
 * entry of D to its original diagonal entry tells how accurate it is; if that is small, a caller
 * uses another method. A chain of N links takes work N.
 *
 * Source  Davis, Direct Methods for Sparse Linear Systems (2006), 4.8 (up-looking
 *         factorisation), ch. 7 (least degree); Vanderbei, SIAM J. Optim. 5 (1995) 100.
 * Tests   tests/num/test_sparse.c
 */
#ifndef QDOT_NUM_SPARSE_H
#define QDOT_NUM_SPARSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* An entry of the matrix that may be non-zero, from either triangle; each pair once. */
typedef struct {
    uint32_t row, column;
    const double *value; /* the value of this entry, read by each factorisation; borrowed */
} qdot_sparse_entry;

typedef struct {
    size_t n, positive;
    uint32_t *order; /* [n] the unknown at each position of the elimination order */
    /* Offsets of the given entries by row, of the rows of K, and of the columns of L. */
    size_t *given_start, *row_start, *column_start; /* [n + 1] each */
    qdot_sparse_entry *given;
    uint32_t *row_column;
    size_t *row_at;
    uint32_t *column_row;
    double *L;       /* entries of the factor L, by columns */
    double *inverse; /* [n] the inverse of the diagonal D */
    double *y, *low; /* [n] scratch; y is 0 between calls */
    size_t filled;   /* number of entries of L */
    bool definite; /* in the last factorisation the positive unknowns were definite beyond rounding */
} qdot_sparse;

/* Prepare for a matrix with these entries [count], rows and columns below n. QDOT_ENOMEM; clear s
 * in any case. */
QDOT_MUST_CHECK qdot_status qdot_sparse_init(qdot_sparse *s, size_t n, size_t positive,
                                             size_t count,
                                             const qdot_sparse_entry *entries);
void qdot_sparse_clear(qdot_sparse *s);

/* Factor with the present values of the entries. Returns the least ratio of |D_k| to K_kk or to
 * the contribution of the positive unknowns: 0 ... 1, the squared sine between a row and those
 * before it. 0, with the factors undefined, if a sign is wrong or something is not finite. */
double qdot_sparse_factor(qdot_sparse *s);

/* Solve a linear system with the factors in s; b [n] is overwritten by the solution. */
void qdot_sparse_solve(const qdot_sparse *s, double *b);

/* Subtract K x from b, for the given matrix K, in twice the precision. */
void qdot_sparse_subtract(const qdot_sparse *s, const double *x, double *b);

#endif
