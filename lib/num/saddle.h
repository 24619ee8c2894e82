/* saddle.h -- saddle-point systems of any rank, for motions under constraints.
 *
 *     [ M  A^T ] [ x  ]   [ b ]      M n x n symmetric, A m x n,
 *     [ A   0  ] [ mu ] = [ c ]      M regular on the null space of A (maybe only there)
 *
 * By the null space: with Q R = A^T P, columns pivoted, Y the first r columns of Q, Z the
 * others,
 *
 *     R_r^T y = (P^T c)_r,   (Z^T M Z) z = Z^T (b - M Y y),   x = Y y + Z z,
 *     R P^T mu = Y^T (b - M x).
 *
 * r is the rank of A. If r < m some rows are redundant: x is the same whichever r independent
 * rows are used, and mu is the solution with the least sum of (mu_k/weight_k)^2. The first factorisation finds the rank,
 * which is then kept: rounding at a later state cannot make dependent, or nearly dependent, rows
 * independent.
 *
 * Unknowns and rows are scaled by powers of two, which make the diagonal of M and the
 * rows of A about 1: neither rank nor rounding depends on units. A row that has shrunk, while
 * others may replace it, keeps its earlier scale, because its direction is rounding.
 *
 * A mass that goes to 0 (a pole of the coordinates, the rotation of a thin rod about itself)
 * keeps its scale too.
 *
 * If the pattern of nonzero entries is given, M is positive definite and the rows of A are
 * independent, the system is factored with that pattern instead (num/sparse.h), which is faster,
 * for a chain by orders of magnitude. The null space decides the rank, and is used again if the
 * independence falls below a fifth of what it was.
 *
 * Source  Golub & Van Loan, Matrix Computations, 4th ed., 5.4 (pivoted QR, complete
 *         orthogonal decomposition), 6.2 (the null-space method); Benzi, Golub & Liesen,
 *         Acta Numerica 14 (2005) 1, sec. 6.
 * Tests   tests/num/test_saddle.c
 */
#ifndef QDOT_NUM_SADDLE_H
#define QDOT_NUM_SADDLE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"
#include "num/ldlt.h"
#include "num/sparse.h"

/* Work space for linear systems of one size; nothing is allocated after qdot_saddle_init. */
typedef struct {
    size_t n, m;
    double *M; /* [n x n] written by the caller, both triangles */
    double *A; /* [m x n] written by the caller */
    double *x; /* [n + m] right-hand side (b, c), then solution (x, mu) */
    const double *weight; /* [m] weights of the multipliers, > 0; NULL: all 1 */

    size_t rank;      /* r; QDOT_SADDLE_UNKNOWN before the first factorisation */
    double quality;   /* |R_rr / R_11| of the last factorisation; 1 if r is 0 */
    double surplus;   /* |R_kk / R_11| of the largest column beyond the rank, which was left out; 0 if there is none */
    size_t factored;  /* how many factorisations have been made */
    size_t last;      /* position of the last pivot; after a failure, of the pivot that failed */
    size_t *pivot;    /* [m] the rows of A in the order of pivoting */
    double *widest; /* [m] largest squared norm of each row of A so far; the caller may set a start value */
    bool aside;       /* do not let the rows of A at this state update `widest` */
    double *heaviest; /* [n] largest value of each diagonal entry of M so far */

    bool indefinite; /* Z^T M Z is factored as LDL^T, otherwise by Cholesky */
    double *d, *e;   /* [n], [m] scale factors of unknowns and of rows of A */
    double *S;       /* [n x n] the scaled matrix M */
    double *Q;       /* [n x n] transposed: row j is column j of Q */
    double *R; /* [m x n] row j is column j of the triangular factor of A^T, with Householder vectors below it */
    double *beta;    /* [m] factors of the Householder reflections */
    double *N;       /* [n x n] Z^T M Z, then its factors */
    double *V, *T;   /* [m x m] the factors of R^T = V T if r < m */
    double *inverse; /* [w x (n + m)] columns of the inverse, padded to w >= n + m, whole vectors */
    double *u, *w, *y, *keep; /* [n + m + 8] each: scratch */
    qdot_ldlt ldlt;

    size_t *start; /* [m + 1] row i of A may be non-zero at column[start[i]] ... column[start[i + 1] - 1] */
    uint32_t *column; /* [start[m]] the columns of these entries */
    bool patterned;   /* the caller gave the pattern of A; otherwise all entries count */
    qdot_sparse sparse;
    double record; /* the largest `quality` (smallest pivot ratio) that a sparse factorisation has found so far */
    bool direct;   /* the last factorisation was the sparse one */
} qdot_saddle;

/* The position (row and column) of an entry of M or A. */
typedef struct {
    uint32_t row, column;
} qdot_saddle_entry;

#define QDOT_SADDLE_UNKNOWN ((size_t)-1)

/* Allocate work space for n > 0 unknowns and m rows, where m may be 0 and may exceed n.
 * QDOT_ENOMEM; clear s in any case. */
QDOT_MUST_CHECK qdot_status qdot_saddle_init(qdot_saddle *s, size_t n, size_t m,
                                             bool indefinite);
void qdot_saddle_clear(qdot_saddle *s);

/* Set the entries that may be nonzero: of M one triangle [masses], of A by rows ascending
 * [slopes]. Call it before the first factorisation. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_saddle_pattern(qdot_saddle *s, size_t masses,
                                                const qdot_saddle_entry *of_M,
                                                size_t slopes,
                                                const qdot_saddle_entry *of_A);

/* Row k of A times x [n]; qdot_saddle_row_size: sum |A_ki| max(|x_i|, least). */
double qdot_saddle_row(const qdot_saddle *s, size_t k, const double *x);
double qdot_saddle_row_size(const qdot_saddle *s, size_t k, const double *x,
                            double least);

/* A row that has shrunk below 1e-7 of its largest size, so that its direction is rounding; m:
 * there is none. Call it once before each factorisation. */
size_t qdot_saddle_faded(qdot_saddle *s);

/* Whether the norm of some row of A is more than twice its largest value so far. */
bool qdot_saddle_widens(const qdot_saddle *s);

/* Whether row k of A had shrunk to rounding errors at the latest call of qdot_saddle_faded. */
bool qdot_saddle_has_faded(const qdot_saddle *s, size_t k);

/* The length of row k of A relative to its largest at earlier calls of qdot_saddle_faded; 1 at the first call. */
double qdot_saddle_remains(const qdot_saddle *s, size_t k);

/* Factor for M and A, which are kept. QDOT_ESINGULAR: A has lost rank
 * (*failed is a row of it, n + k), or M is singular on its null space (*failed is an
 * unknown), or something is not finite. QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_saddle_factor(qdot_saddle *s, size_t *failed);

/* Factor by the null space even if there is a sparsity pattern: this detects nearly dependent rows. */
QDOT_MUST_CHECK qdot_status qdot_saddle_factor_fully(qdot_saddle *s, size_t *failed);

/* How far the rows of A are from losing rank, 0 ... 1; 0 if they have lost it. Not counted as a
 * factorisation, and not usable for solving. */
double qdot_saddle_independence(qdot_saddle *s);

/* Solve the system for s->x, which holds the right-hand side before and the solution afterwards. */
void qdot_saddle_solve(qdot_saddle *s);

/* Solve the system for s->x, and correct the solution once by the residual in twice the precision. */
void qdot_saddle_solve_refined(qdot_saddle *s);

/* For many right-hand sides: call _prepare once, then _apply for each s->x. Its error is usually
 * of the size of _solve's. */
void qdot_saddle_prepare(qdot_saddle *s);
void qdot_saddle_apply(qdot_saddle *s);

/* The combination of rows nearest to 0, and its direction: row [m] and column [n] with row^T A
 * about R_rr column^T, after a factorisation that was not `direct`. r > 0. */
void qdot_saddle_weakest(qdot_saddle *s, double *row, double *column);

/* part [m]: the size of each row's part, 0 ... 1, in the nearest dependencies on the pivots that are larger than
 * `below` times the first (never the last): as many as the rank has lost, those of the fewest rows; and those of
 * omitted rows that share rows with these and are no longer redundant. */
void qdot_saddle_parts(qdot_saddle *s, double below, double *part);

#endif
