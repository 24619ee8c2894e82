/* lu.c -- Gaussian elimination by rows, only between the first and the last non-zero entry of each row. */
#include "num/lu.h"

#include <math.h>

static inline void
swap_numbers(double *a, double *b)
{
    const double kept = *a;

    *a = *b;
    *b = kept;
}

/* Exchange rows i and j of A [n x n]. */
static void
exchange_rows(size_t n, double *A, size_t i, size_t j)
{
    for (size_t c = 0; c < n; c++)
        swap_numbers(A + i * n + c, A + j * n + c);
}

/* Find the first and the last non-zero entry of each row; the imaginary part im may be NULL. */
static void
find_row_ends(size_t n, const double *re, const double *im, qdot_lu_row *rows)
{
    for (size_t i = 0; i < n; i++, re += n, im = im ? im + n : NULL) {
        size_t from = 0, to = n;

        while (from < i && re[from] == 0 && (!im || im[from] == 0))
            from++;
        while (to > i + 1 && re[to - 1] == 0 && (!im || im[to - 1] == 0))
            to--;
        rows[i].from = from;
        rows[i].to = to;
    }
}

/* Move row `best` to position k, which gets the pivot row. */
static void
move_row_to(size_t n, double *re, double *im, qdot_lu_row *rows, size_t k, size_t best)
{
    const qdot_lu_row kept = rows[k];

    rows[k].pivot = best;
    if (best == k)
        return;
    exchange_rows(n, re, k, best);
    if (im)
        exchange_rows(n, im, k, best);
    rows[k].from = rows[best].from;
    rows[k].to = rows[best].to;
    rows[best].from = kept.from;
    rows[best].to = kept.to;
}

bool
qdot_lu_factor(size_t n, double *A, qdot_lu_row *rows)
{
    find_row_ends(n, A, NULL, rows);
    for (size_t k = 0; k < n; k++) {
        const double *restrict from = A + k * n;
        size_t best = k;
        double inverse;

        for (size_t i = k + 1; i < n; i++)
            if (fabs(A[i * n + k]) > fabs(A[best * n + k]))
                best = i;
        move_row_to(n, A, NULL, rows, k, best);
        inverse = 1 / from[k];
        if (!isfinite(inverse) || inverse == 0)
            return false;
        for (size_t i = k + 1; i < n; i++) {
            double *restrict row = A + i * n;
            double by;

            if (row[k] == 0)
                continue;
            by = row[k] *= inverse;
            for (size_t j = k + 1; j < rows[k].to; j++)
                row[j] -= by * from[j];
            if (rows[i].to < rows[k].to)
                rows[i].to = rows[k].to;
        }
    }
    return true;
}

void
qdot_lu_solve(size_t n, const double *A, const qdot_lu_row *rows, double *b)
{
    for (size_t k = 0; k < n; k++)
        swap_numbers(b + k, b + rows[k].pivot);
    for (size_t i = 1; i < n; i++)
        for (size_t j = rows[i].from; j < i; j++)
            b[i] -= A[i * n + j] * b[j];
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < rows[i].to; j++)
            b[i] -= A[i * n + j] * b[j];
        b[i] /= A[i * n + i];
    }
}

/* Eliminate column k from a lower row by the pivot row, in the columns before `to`. */
static void
eliminate_from_row(size_t to, size_t k, const double *restrict from_re,
                   const double *restrict from_im, const double *inverse, double *restrict re,
                   double *restrict im)
{
    const double by_re = re[k] * inverse[0] - im[k] * inverse[1];
    const double by_im = re[k] * inverse[1] + im[k] * inverse[0];

    re[k] = by_re;
    im[k] = by_im;
    for (size_t j = k + 1; j < to; j++) {
        re[j] -= by_re * from_re[j] - by_im * from_im[j];
        im[j] -= by_re * from_im[j] + by_im * from_re[j];
    }
}

bool
qdot_lu_factor_complex(size_t n, double *re, double *im, qdot_lu_row *rows)
{
    find_row_ends(n, re, im, rows);
    for (size_t k = 0; k < n; k++) {
        size_t best = k;
        double most = 0, a, b, size, inverse[2];

        for (size_t i = k; i < n; i++) {
            const double here = fabs(re[i * n + k]) + fabs(im[i * n + k]);

            if (here > most) {
                most = here;
                best = i;
            }
        }
        move_row_to(n, re, im, rows, k, best);
        a = re[k * n + k] / most;
        b = im[k * n + k] / most;
        size = most * (a * a + b * b);
        if (!isfinite(size) || !(size > 0))
            return false;
        re[k * n + k] = inverse[0] = a / size;
        im[k * n + k] = inverse[1] = -b / size;
        for (size_t i = k + 1; i < n; i++) {
            if (re[i * n + k] == 0 && im[i * n + k] == 0)
                continue;
            eliminate_from_row(rows[k].to, k, re + k * n, im + k * n, inverse, re + i * n,
                               im + i * n);
            if (rows[i].to < rows[k].to)
                rows[i].to = rows[k].to;
        }
    }
    return true;
}

/* Subtract the known part of row i: x + i y -= (row i of re + i im, columns from ... to - 1) (x + i y) */
static inline void
subtract_known_part(const double *re, const double *im, size_t i, size_t from, size_t to, double *x,
                    double *y)
{
    for (size_t j = from; j < to; j++) {
        x[i] -= re[j] * x[j] - im[j] * y[j];
        y[i] -= re[j] * y[j] + im[j] * x[j];
    }
}

void
qdot_lu_solve_complex(size_t n, const double *re, const double *im,
                      const qdot_lu_row *rows, double *x, double *y)
{
    for (size_t k = 0; k < n; k++) {
        swap_numbers(x + k, x + rows[k].pivot);
        swap_numbers(y + k, y + rows[k].pivot);
    }
    for (size_t i = 1; i < n; i++)
        subtract_known_part(re + i * n, im + i * n, i, rows[i].from, i, x, y);
    for (size_t i = n; i-- > 0;) {
        const double c = re[i * n + i], d = im[i * n + i];
        double u, v;

        subtract_known_part(re + i * n, im + i * n, i, i + 1, rows[i].to, x, y);
        u = x[i];
        v = y[i];
        x[i] = u * c - v * d;
        y[i] = v * c + u * d;
    }
}

/* --- ordering rows to save work ------------------------------------------------------- */

static size_t
neighbours(size_t n, const bool *pattern, size_t i)
{
    size_t count = 0;

    for (size_t j = 0; j < n; j++)
        count += j != i && pattern[i * n + j];
    return count;
}

/* The unknown of fewest neighbours among those not taken yet that are next to i (i == n: any); n if
 * there is none. taken[i]: 1 where i stands in the order. */
static size_t
next_neighbour(size_t n, const bool *pattern, const size_t *taken, size_t i)
{
    size_t best = n, fewest = n + 1;

    for (size_t j = 0; j < n; j++) {
        if (taken[j] || (i < n && !pattern[i * n + j]))
            continue;
        if (neighbours(n, pattern, j) < fewest) {
            fewest = neighbours(n, pattern, j);
            best = j;
        }
    }
    return best;
}

void
qdot_lu_order(size_t n, const bool *pattern, size_t *order, size_t *scratch)
{
    size_t count = 0, done = 0;

    for (size_t i = 0; i < n; i++)
        scratch[i] = 0;
    while (count < n) {
        size_t next = next_neighbour(n, pattern, scratch, done < count ? order[done] : n);

        if (next == n) {
            done++;
            continue;
        }
        scratch[next] = 1;
        order[count++] = next;
    }
}
