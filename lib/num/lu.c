/* lu.c -- Gaussian elimination by rows. */
#include "num/lu.h"

#include <math.h>

static inline void
swap(double *a, double *b)
{
    const double kept = *a;

    *a = *b;
    *b = kept;
}

/* Exchange rows i and j of A [n x n]. */
static void
exchange(size_t n, double *A, size_t i, size_t j)
{
    for (size_t c = 0; c < n && i != j; c++)
        swap(A + i * n + c, A + j * n + c);
}

bool
qdot_lu_factor(size_t n, double *A, size_t *pivot)
{
    for (size_t k = 0; k < n; k++) {
        const double *restrict from = A + k * n;
        size_t best = k;
        double inverse;

        for (size_t i = k + 1; i < n; i++)
            if (fabs(A[i * n + k]) > fabs(A[best * n + k]))
                best = i;
        pivot[k] = best;
        exchange(n, A, k, best);
        inverse = 1 / from[k];
        if (!isfinite(inverse) || inverse == 0)
            return false;
        for (size_t i = k + 1; i < n; i++) {
            double *restrict row = A + i * n;
            const double by = row[k] *= inverse;

            for (size_t j = k + 1; j < n && by != 0; j++)
                row[j] -= by * from[j];
        }
    }
    return true;
}

void
qdot_lu_solve(size_t n, const double *A, const size_t *pivot, double *b)
{
    for (size_t k = 0; k < n; k++)
        swap(b + k, b + pivot[k]);
    for (size_t i = 1; i < n; i++)
        for (size_t j = 0; j < i; j++)
            b[i] -= A[i * n + j] * b[j];
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++)
            b[i] -= A[i * n + j] * b[j];
        b[i] /= A[i * n + i];
    }
}

/* Eliminate column k from one row below it. */
static void
eliminate(size_t n, size_t k, const double *restrict from_re,
          const double *restrict from_im, double inverse_re, double inverse_im,
          double *restrict re, double *restrict im)
{
    const double by_re = re[k] * inverse_re - im[k] * inverse_im;
    const double by_im = re[k] * inverse_im + im[k] * inverse_re;

    re[k] = by_re;
    im[k] = by_im;
    if (by_re == 0 && by_im == 0)
        return;
    for (size_t j = k + 1; j < n; j++) {
        re[j] -= by_re * from_re[j] - by_im * from_im[j];
        im[j] -= by_re * from_im[j] + by_im * from_re[j];
    }
}

bool
qdot_lu_factor_complex(size_t n, double *re, double *im, size_t *pivot)
{
    for (size_t k = 0; k < n; k++) {
        size_t best = k;
        double most = 0, a, b, size;

        for (size_t i = k; i < n; i++) {
            const double here = fabs(re[i * n + k]) + fabs(im[i * n + k]);

            if (here > most) {
                most = here;
                best = i;
            }
        }
        pivot[k] = best;
        exchange(n, re, k, best);
        exchange(n, im, k, best);
        a = re[k * n + k] / most;
        b = im[k * n + k] / most;
        size = most * (a * a + b * b);
        if (!isfinite(size) || !(size > 0))
            return false;
        for (size_t i = k + 1; i < n; i++)
            eliminate(n, k, re + k * n, im + k * n, a / size, -b / size, re + i * n,
                      im + i * n);
    }
    return true;
}

void
qdot_lu_solve_complex(size_t n, const double *re, const double *im, const size_t *pivot,
                      double *x, double *y)
{
    for (size_t k = 0; k < n; k++) {
        swap(x + k, x + pivot[k]);
        swap(y + k, y + pivot[k]);
    }
    for (size_t i = 1; i < n; i++)
        for (size_t j = 0; j < i; j++) {
            const double a = re[i * n + j], b = im[i * n + j];

            x[i] -= a * x[j] - b * y[j];
            y[i] -= a * y[j] + b * x[j];
        }
    for (size_t i = n; i-- > 0;) {
        double c = re[i * n + i], d = im[i * n + i], size = fmax(fabs(c), fabs(d)), u, v;

        for (size_t j = i + 1; j < n; j++) {
            const double a = re[i * n + j], b = im[i * n + j];

            x[i] -= a * x[j] - b * y[j];
            y[i] -= a * y[j] + b * x[j];
        }
        u = x[i] / size;
        v = y[i] / size;
        c /= size;
        d /= size;
        size = c * c + d * d;
        x[i] = (u * c + v * d) / size;
        y[i] = (v * c - u * d) / size;
    }
}
