/* ldlt.c -- LDL^T factorisation with symmetric pivoting of the lower triangle, column by column. */
#include "num/ldlt.h"

#include <float.h>
#include <math.h>

#include "base/memory.h"

/* Bunch and Kaufman's (1 + sqrt 17) / 8: two 1 x 1 steps then let entries grow as much as one 2 x 2 step. */
static const double alpha = 0.6403882032022076;

qdot_status
qdot_ldlt_init(qdot_ldlt *f, size_t n)
{
    *f = (qdot_ldlt){.n = n};
    f->order = qdot_calloc(n + 1, sizeof *f->order);
    f->pair = qdot_calloc(n + 1, sizeof *f->pair);
    f->scale = qdot_calloc(n + 1, sizeof *f->scale);
    f->work = qdot_calloc(n + 1, sizeof *f->work);
    if (f->order && f->pair && f->scale && f->work)
        return QDOT_OK;
    qdot_ldlt_clear(f);
    return QDOT_ENOMEM;
}

void
qdot_ldlt_clear(qdot_ldlt *f)
{
    qdot_free(f->order);
    qdot_free(f->pair);
    qdot_free(f->scale);
    qdot_free(f->work);
    *f = (qdot_ldlt){0};
}

static qdot_status
singular(size_t unknown, size_t *failed)
{
    if (failed)
        *failed = unknown;
    return qdot_fail(QDOT_ESINGULAR, "the matrix is singular (row %zu)", unknown + 1);
}

/* Find the largest |entry| of each row of S A S; S is diagonal and holds the scales of the unknowns. */
static void
find_row_maxima(const double *a, size_t n, const double *scale, double *largest)
{
    for (size_t i = 0; i < n; i++)
        largest[i] = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double x = fabs(scale[i] * a[i * n + j] * scale[j]);

            if (isnan(x))
                x = INFINITY;
            largest[i] = fmax(largest[i], x);
            largest[j] = fmax(largest[j], x);
        }
}

/* Choose S and apply it. Each pass halves the exponents that are left; a row of zeros or
 * an entry that is not finite is told. */
static qdot_status
equilibrate_matrix(qdot_ldlt *f, double *a, size_t *failed)
{
    const size_t n = f->n;

    for (size_t i = 0; i < n; i++)
        f->scale[i] = 1;
    for (int pass = 0; pass < 8; pass++) {
        bool changed = false;

        find_row_maxima(a, n, f->scale, f->work);
        for (size_t i = 0; i < n; i++) {
            int e;

            if (!(f->work[i] > 0 && f->work[i] < INFINITY))
                return singular(i, failed);
            frexp(f->work[i], &e);
            if (e / 2 != 0) {
                f->scale[i] = ldexp(f->scale[i], -(e / 2));
                changed = true;
            }
        }
        if (!changed)
            break;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            a[i * n + j] *= f->scale[i] * f->scale[j];
    return QDOT_OK;
}

static void
swap_numbers(double *x, double *y)
{
    double t = *x;

    *x = *y;
    *y = t;
}

/* Exchange the unknowns p < q of the symmetric matrix, and the corresponding rows of the factor L. */
static void
interchange_unknowns(qdot_ldlt *f, double *a, size_t p, size_t q)
{
    const size_t n = f->n;
    size_t o = f->order[p];

    f->order[p] = f->order[q];
    f->order[q] = o;
    for (size_t j = 0; j < p; j++)
        swap_numbers(&a[p * n + j], &a[q * n + j]);
    for (size_t j = p + 1; j < q; j++)
        swap_numbers(&a[j * n + p], &a[q * n + j]);
    for (size_t i = q + 1; i < n; i++)
        swap_numbers(&a[i * n + p], &a[i * n + q]);
    swap_numbers(&a[p * n + p], &a[q * n + q]);
}

/* The largest |entry| of column c among the rows from k on, except the diagonal entry. */
static double
column_maximum(const double *a, size_t n, size_t k, size_t c, size_t *at)
{
    double largest = 0;

    for (size_t i = k; i < n; i++) {
        double x = i == c ? 0 : fabs(i > c ? a[i * n + c] : a[c * n + i]);

        if (x > largest) {
            largest = x;
            *at = i;
        }
    }
    return largest;
}

static void
eliminate_single_pivot(double *a, size_t n, size_t k)
{
    for (size_t i = k + 1; i < n; i++) {
        double l = a[i * n + k] / a[k * n + k];

        for (size_t j = k + 1; j <= i; j++)
            a[i * n + j] -= l * a[j * n + k];
    }
    for (size_t i = k + 1; i < n; i++)
        a[i * n + k] /= a[k * n + k];
}

/* Solve with the 2 x 2 block D at row k: replace (x, y) by D^-1 (x, y), in a form that does not overflow. */
static void
solve_with_pivot_pair(const double *a, size_t n, size_t k, double *x, double *y)
{
    double d21 = a[(k + 1) * n + k], d11 = a[k * n + k] / d21;
    double d22 = a[(k + 1) * n + k + 1] / d21, det = d11 * d22 - 1;
    double u = *x / d21, v = *y / d21;

    *x = (d22 * u - v) / det;
    *y = (d11 * v - u) / det;
}

static void
eliminate_pivot_pair(double *a, size_t n, size_t k)
{
    for (size_t i = k + 2; i < n; i++) {
        double l1 = a[i * n + k], l2 = a[i * n + k + 1];

        solve_with_pivot_pair(a, n, k, &l1, &l2);
        for (size_t j = i; j < n; j++)
            a[j * n + i] -= l1 * a[j * n + k] + l2 * a[j * n + k + 1];
        a[i * n + k] = l1;
        a[i * n + k + 1] = l2;
    }
}

qdot_status
qdot_ldlt_factor(qdot_ldlt *f, double *a, size_t *failed)
{
    const size_t n = f->n;
    const double threshold = 16 * (double)n * DBL_EPSILON;

    QDOT_TRY(equilibrate_matrix(f, a, failed));
    for (size_t i = 0; i < n; i++) {
        f->order[i] = i;
        f->pair[i] = false;
    }
    for (size_t k = 0; k < n;) {
        size_t r = k, ignored = k, pivot = k;
        double diagonal = fabs(a[k * n + k]), lambda = column_maximum(a, n, k, k, &r);
        bool two = false;

        if (!(fmax(diagonal, lambda) > threshold && isfinite(diagonal + lambda)))
            return singular(f->order[k], failed);
        if (diagonal < alpha * lambda) {
            double sigma = column_maximum(a, n, k, r, &ignored);

            if (diagonal * sigma < alpha * lambda * lambda) {
                pivot = r;
                two = fabs(a[r * n + r]) < alpha * sigma;
            }
        }
        if (pivot != k + two)
            interchange_unknowns(f, a, k + two, pivot);
        f->pair[k] = two;
        if (two)
            eliminate_pivot_pair(a, n, k);
        else
            eliminate_single_pivot(a, n, k);
        k += two ? 2 : 1;
    }
    return QDOT_OK;
}

void
qdot_ldlt_solve(const qdot_ldlt *f, const double *a, double *b)
{
    const size_t n = f->n;
    double *x = f->work;

    for (size_t i = 0; i < n; i++)
        x[i] = b[f->order[i]] * f->scale[f->order[i]];
    for (size_t k = 0; k < n; k += f->pair[k] ? 2 : 1)
        for (size_t i = k + 1 + f->pair[k]; i < n; i++) {
            x[i] -= a[i * n + k] * x[k];
            if (f->pair[k])
                x[i] -= a[i * n + k + 1] * x[k + 1];
        }
    for (size_t k = 0; k < n; k += f->pair[k] ? 2 : 1) {
        if (f->pair[k])
            solve_with_pivot_pair(a, n, k, &x[k], &x[k + 1]);
        else
            x[k] /= a[k * n + k];
    }
    for (size_t k = n; k-- > 0;)
        for (size_t i = k + 1 + f->pair[k]; i < n; i++)
            x[k] -= a[i * n + k] * x[i];
    for (size_t i = 0; i < n; i++)
        b[f->order[i]] = x[i] * f->scale[f->order[i]];
}
