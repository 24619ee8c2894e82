/* eigenvalues.c -- eigenvalues and their errors, by GSL. */
#include "num/eigenvalues.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

typedef struct {
    size_t n;
    gsl_matrix *A;
    gsl_matrix_complex *V, *LU, *W; /* right vectors, columns; left ones, rows of V^-1 */
    gsl_vector_complex *lambda, *mu; /* of A, of its transpose */
    gsl_permutation *order;
    gsl_eigen_nonsymmv_workspace *work;
} solver;

static bool
allocate(solver *s)
{
    const size_t n = s->n;

    s->A = gsl_matrix_alloc(n, n);
    s->V = gsl_matrix_complex_alloc(n, n);
    s->LU = gsl_matrix_complex_alloc(n, n);
    s->W = gsl_matrix_complex_alloc(n, n);
    s->lambda = gsl_vector_complex_alloc(n);
    s->mu = gsl_vector_complex_alloc(n);
    s->order = gsl_permutation_alloc(n);
    s->work = gsl_eigen_nonsymmv_alloc(n);
    return s->A && s->V && s->LU && s->W && s->lambda && s->mu && s->order && s->work;
}

static void
release(solver *s)
{
    gsl_matrix_free(s->A);
    gsl_matrix_complex_free(s->V);
    gsl_matrix_complex_free(s->LU);
    gsl_matrix_complex_free(s->W);
    gsl_vector_complex_free(s->lambda);
    gsl_vector_complex_free(s->mu);
    gsl_permutation_free(s->order);
    if (s->work != NULL)
        gsl_eigen_nonsymmv_free(s->work);
}

/* What E, and the rounding of A, make of the k-th. */
static double
error_of(const solver *s, const double *A, const double *E, size_t k)
{
    const size_t n = s->n;
    double sum = 0, size = 0;

    for (size_t i = 0; i < n * n; i++)
        size = fmax(size, fabs(A[i]));
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            sum += gsl_complex_abs(gsl_matrix_complex_get(s->W, k, i)) *
                   (E[i * n + j] + 4 * DBL_EPSILON * size) *
                   gsl_complex_abs(gsl_matrix_complex_get(s->V, j, k));
    return sum;
}

/* Errors by left vectors that are found by themselves, where these are less: V^-1 is lost to all where two other eigenvalues
 * are one with one vector. */
static void
bound_by_left(solver *s, const double *A, const double *E, double *error)
{
    const size_t n = s->n;
    gsl_matrix_complex *const U = s->LU;

    for (size_t i = 0; i < n * n; i++)
        gsl_matrix_set(s->A, i % n, i / n, A[i]);
    if (gsl_eigen_nonsymmv(s->A, s->mu, U, s->work) != GSL_SUCCESS)
        return;
    for (size_t k = 0; k < n; k++) {
        const gsl_complex lambda = gsl_vector_complex_get(s->lambda, k);
        gsl_complex along = gsl_complex_rect(0, 0);
        double nearest = INFINITY;
        size_t at = 0;

        for (size_t j = 0; j < n; j++) {
            const double off = gsl_complex_abs(gsl_complex_sub(gsl_vector_complex_get(s->mu, j), lambda));

            at = off < nearest ? j : at;
            nearest = fmin(nearest, off);
        }
        for (size_t i = 0; i < n; i++)
            along = gsl_complex_add(along, gsl_complex_mul(gsl_matrix_complex_get(U, i, at),
                                                           gsl_matrix_complex_get(s->V, i, k)));
        if (!(gsl_complex_abs(along) > 0))
            continue;
        for (size_t i = 0; i < n; i++)
            gsl_matrix_complex_set(s->W, k, i, gsl_complex_div(gsl_matrix_complex_get(U, i, at), along));
        error[k] = fmin(error[k], error_of(s, A, E, k));
    }
}

static qdot_status
solve(solver *s, const double *A, const double *E, double *re, double *im, double *error)
{
    const size_t n = s->n;
    int sign;

    for (size_t i = 0; i < n * n; i++)
        gsl_matrix_set(s->A, i / n, i % n, A[i]);
    if (gsl_eigen_nonsymmv(s->A, s->lambda, s->V, s->work) != GSL_SUCCESS)
        return qdot_fail(QDOT_EFAILED, "the eigenvalues were not found");
    (void)gsl_eigen_nonsymmv_sort(s->lambda, s->V, GSL_EIGEN_SORT_ABS_DESC);
    (void)gsl_matrix_complex_memcpy(s->LU, s->V);
    const bool known =
        gsl_linalg_complex_LU_decomp(s->LU, s->order, &sign) == GSL_SUCCESS &&
        gsl_linalg_complex_LU_invert(s->LU, s->order, s->W) == GSL_SUCCESS;

    for (size_t k = 0; k < n; k++) {
        re[k] = GSL_REAL(gsl_vector_complex_get(s->lambda, k));
        im[k] = GSL_IMAG(gsl_vector_complex_get(s->lambda, k));
        error[k] = known ? error_of(s, A, E, k) : NAN;
    }
    bound_by_left(s, A, E, error);
    for (size_t k = 0; k + 1 < n; k++)
        if (im[k] < 0 && im[k + 1] == -im[k] && re[k + 1] == re[k]) {
            im[k] = -im[k];
            im[k + 1] = -im[k + 1];
        } else if (im[k] > 0) {
            k++; /* its partner is in its place */
        }
    return QDOT_OK;
}

qdot_status
qdot_eigenvalues(size_t n, const double *A, const double *E, double *re, double *im,
                 double *error)
{
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    solver s = {.n = n};
    qdot_status status = allocate(&s) ? solve(&s, A, E, re, im, error) : QDOT_ENOMEM;

    release(&s);
    gsl_set_error_handler(before);
    return status;
}
