/* cholesky.c -- Cholesky factorisation, of a whole matrix or of a block given by indices. */
#include "num/cholesky.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* The matrix index of row i of a block; `index` NULL stands for the whole matrix. */
static inline size_t
block_member(const size_t *index, size_t i)
{
    return index ? index[i] : i;
}

/* Row i of L, without its diagonal, is there: is its pivot d more than rounding? Uses
 * column i above the diagonal for v; a row of L has the norm sqrt(a_jj). */
static bool
pivot_is_significant(double *a, size_t n, const size_t *index, size_t i, double diagonal, double d)
{
    const size_t column = block_member(index, i);
    const double *ai = a + column * n;
    double size = sqrt(diagonal);

    for (size_t j = i; j-- > 0;) {
        const double *aj = a + block_member(index, j) * n;
        double v = ai[block_member(index, j)], norm = 0;

        for (size_t k = j + 1; k < i; k++) {
            const double *ak = a + block_member(index, k) * n;

            v -= ak[block_member(index, j)] * ak[column];
        }
        v /= aj[block_member(index, j)];
        a[block_member(index, j) * n + column] = v;
        for (size_t k = 0; k <= j; k++)
            norm += aj[block_member(index, k)] * aj[block_member(index, k)];
        size += fabs(v) * sqrt(norm);
    }
    return d > 4 * (double)(i + 1) * DBL_EPSILON * size * size;
}

/* Factor the block with the m rows and columns `index`; returns m, or the index of a pivot that is not clearly positive. */
static inline size_t
factor_block(double *a, size_t n, const size_t *index, size_t m)
{
    double lost = 1; /* the smallest ratio d / a_kk of a pivot to its original entry so far */

    for (size_t i = 0; i < m; i++) {
        double *ai = a + block_member(index, i) * n;
        double diagonal = ai[block_member(index, i)], d = diagonal;

        for (size_t j = 0; j < i; j++) {
            const double *aj = a + block_member(index, j) * n;
            double x = ai[block_member(index, j)];

            for (size_t k = 0; k < j; k++)
                x -= ai[block_member(index, k)] * aj[block_member(index, k)];
            x /= aj[block_member(index, j)];
            ai[block_member(index, j)] = x;
            d -= x * x;
        }
        if (!(d > 0 && d < INFINITY))
            return i;
        lost = fmin(lost, d / diagonal);
        if (lost < 1e-4 && !pivot_is_significant(a, n, index, i, diagonal, d))
            return i;
        ai[block_member(index, i)] = sqrt(d);
    }
    return m;
}

static inline void
solve_block(const double *a, size_t n, const size_t *index, size_t m, double *b)
{
    for (size_t i = 0; i < m; i++) {
        const double *ai = a + block_member(index, i) * n;
        double x = b[block_member(index, i)];

        for (size_t k = 0; k < i; k++)
            x -= ai[block_member(index, k)] * b[block_member(index, k)];
        b[block_member(index, i)] = x / ai[block_member(index, i)];
    }
    for (size_t i = m; i-- > 0;) {
        const double *ai = a + block_member(index, i) * n;
        double x = b[block_member(index, i)] / ai[block_member(index, i)];

        b[block_member(index, i)] = x;
        for (size_t k = 0; k < i; k++)
            b[block_member(index, k)] -= x * ai[block_member(index, k)];
    }
}

static qdot_status
singular(size_t row, size_t *failed)
{
    if (failed)
        *failed = row;
    return qdot_fail(QDOT_ESINGULAR,
                     "the matrix is singular or not positive definite (row %zu)",
                     row + 1);
}

qdot_status
qdot_cholesky_factor(double *a, size_t n, const qdot_structure *s, size_t *failed)
{
    if (!s || qdot_structure_is_full(s)) {
        size_t bad = factor_block(a, n, NULL, n);

        return bad == n ? QDOT_OK : singular(bad, failed);
    }
    for (size_t b = 0; b < s->blocks; b++) {
        const size_t *index = s->index + s->start[b];
        size_t m = s->start[b + 1] - s->start[b], bad = factor_block(a, n, index, m);

        if (bad != m)
            return singular(index[bad], failed);
    }
    return QDOT_OK;
}

void
qdot_cholesky_solve(const double *a, size_t n, const qdot_structure *s, double *b)
{
    if (!s || qdot_structure_is_full(s)) {
        solve_block(a, n, NULL, n, b);
        return;
    }
    for (size_t k = 0; k < s->blocks; k++)
        solve_block(a, n, s->index + s->start[k], s->start[k + 1] - s->start[k], b);
}
