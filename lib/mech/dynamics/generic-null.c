/* generic-null.c -- linear relations between expressions, from their values at random points. */
#include "mech/dynamics/generic-null.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_linalg.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"

enum { MOST_DENOMINATOR = 12 };

/* Fill A [height * columns] with rows of e at random points, each row scaled to length 1; rows of zeros are left out. */
static qdot_status
sample_rows(const qdot_pool *pool, size_t rows, size_t columns, const qdot_expr *e, const qdot_generic_point *at, double *A,
            size_t height)
{
    double *out = qdot_calloc(rows * columns + 1, sizeof *out);
    qdot_generic_point point = *at;
    qdot_status status = out == NULL ? QDOT_ENOMEM : QDOT_OK;
    size_t done = 0;

    for (point.seed = 2; status == QDOT_OK && done < height && point.seed < 4 * height + 20; point.seed++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = qdot_generic_evaluate(pool, rows * columns, e, &point, out);
        for (size_t i = 0; status == QDOT_OK && i < rows && done < height; i++) {
            double length = 0;

            for (size_t j = 0; j < columns; j++)
                length = hypot(length, out[i * columns + j]);
            if (!isfinite(length) || length == 0)
                continue;
            for (size_t j = 0; j < columns; j++)
                A[done * columns + j] = out[i * columns + j] / length;
            done++;
        }
    }
    qdot_free(out);
    return status;
}

qdot_status
qdot_generic_null(const qdot_pool *pool, size_t rows, size_t columns, const qdot_expr *e, const qdot_generic_point *at,
                  double **basis, size_t *count)
{
    const size_t height = 3 * columns + 2 * rows;
    gsl_matrix *A = gsl_matrix_calloc(height, columns), *V = gsl_matrix_alloc(columns, columns);
    gsl_vector *sigma = gsl_vector_alloc(columns), *work = gsl_vector_alloc(columns);
    qdot_status status = QDOT_ENOMEM;

    *count = 0;
    *basis = qdot_calloc(columns * columns + 1, sizeof **basis);
    if (A != NULL && V != NULL && sigma != NULL && work != NULL && *basis != NULL)
        status = sample_rows(pool, rows, columns, e, at, A->data, height);
    if (status == QDOT_OK) {
        /* not Jacobi's method, because GSL's takes columns for rounding errors after many rotations */
        gsl_linalg_SV_decomp(A, V, sigma, work);
        for (size_t k = 0; k < columns; k++) {
            if (gsl_vector_get(sigma, k) > 1e-9 * gsl_vector_get(sigma, 0))
                continue;
            for (size_t j = 0; j < columns; j++)
                (*basis)[*count * columns + j] = gsl_matrix_get(V, j, k);
            ++*count;
        }
    }
    gsl_matrix_free(A);
    gsl_matrix_free(V);
    gsl_vector_free(sigma);
    gsl_vector_free(work);
    return status;
}

/* Bring B [count * columns], rows of full rank, to reduced row echelon form: Gauss and Jordan, the largest entry of a column
 * as pivot, less than 1e-6 counting as 0. */
static void
reduce_rows(double *B, size_t count, size_t columns)
{
    size_t row = 0;

    for (size_t j = 0; j < columns && row < count; j++) {
        size_t best = row;

        for (size_t k = row; k < count; k++)
            if (fabs(B[k * columns + j]) > fabs(B[best * columns + j]))
                best = k;
        if (fabs(B[best * columns + j]) < 1e-6)
            continue;
        for (size_t i = 0; i < columns; i++) {
            const double x = B[best * columns + i];

            B[best * columns + i] = B[row * columns + i];
            B[row * columns + i] = x;
        }
        for (size_t i = columns; i-- > j;)
            B[row * columns + i] /= B[row * columns + j];
        for (size_t k = 0; k < count; k++) {
            const double by = k == row ? 0 : B[k * columns + j];

            for (size_t i = j; i < columns && by != 0; i++)
                B[k * columns + i] -= by * B[row * columns + i];
        }
        row++;
    }
}

/* The fraction with a small denominator that x is, nil if it is none. */
static qdot_expr
small_fraction(qdot_pool *pool, double x)
{
    for (int64_t d = 1; d <= MOST_DENOMINATOR && fabs(x) < 1000; d++)
        if (fabs(d * x - round(d * x)) < 1e-7)
            return qdot_expr_ratio(pool, llround(d * x), d);
    return QDOT_NIL;
}

qdot_status
qdot_generic_null_exact(qdot_pool *pool, size_t rows, size_t columns, const qdot_expr *e, qdot_expr **basis, size_t *count)
{
    double *numbers = NULL;
    qdot_status status = qdot_generic_null(pool, rows, columns, e, &(qdot_generic_point){.m = 0}, &numbers, count);
    bool exact = true;

    *basis = status == QDOT_OK ? qdot_calloc(*count * columns + 1, sizeof **basis) : NULL;
    if (status == QDOT_OK && *basis == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK) {
        reduce_rows(numbers, *count, columns);
        for (size_t k = 0; k < *count * columns && exact; k++) {
            (*basis)[k] = small_fraction(pool, numbers[k]);
            exact = (*basis)[k] != QDOT_NIL;
        }
        status = qdot_pool_check(pool);
    }
    if (!exact || status != QDOT_OK)
        *count = 0;
    qdot_free(numbers);
    return status;
}
