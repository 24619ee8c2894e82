/* eigenmodes.c -- decomposes a vector into eigenvectors of a matrix, by GSL and a linear system. */
#include "num/eigenmodes.h"

#include <stdbool.h>

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

typedef struct {
    gsl_matrix *A;
    gsl_matrix_complex *V; /* eigenvectors as columns; then the LU factors of this matrix */
    gsl_vector_complex *lambda, *f, *c;
    gsl_permutation *order;
    gsl_eigen_nonsymmv_workspace *work;
} solver;

static bool
eigenmodes_allocate(solver *s, size_t n)
{
    s->A = gsl_matrix_alloc(n, n);
    s->V = gsl_matrix_complex_alloc(n, n);
    s->lambda = gsl_vector_complex_alloc(n);
    s->f = gsl_vector_complex_alloc(n);
    s->c = gsl_vector_complex_alloc(n);
    s->order = gsl_permutation_alloc(n);
    s->work = gsl_eigen_nonsymmv_alloc(n);
    return s->A && s->V && s->lambda && s->f && s->c && s->order && s->work;
}

static void
eigenmodes_release(solver *s)
{
    gsl_matrix_free(s->A);
    gsl_matrix_complex_free(s->V);
    gsl_vector_complex_free(s->lambda);
    gsl_vector_complex_free(s->f);
    gsl_vector_complex_free(s->c);
    gsl_permutation_free(s->order);
    if (s->work != NULL)
        gsl_eigen_nonsymmv_free(s->work);
}

static double complex
complex_of_gsl(gsl_complex z)
{
    return GSL_REAL(z) + I * GSL_IMAG(z);
}

static qdot_status
eigenmodes_solve(solver *s, size_t n, const double *A, const double *f, double complex *lambda,
                 double complex *v, double complex *c)
{
    int sign;

    for (size_t i = 0; i < n; i++) {
        gsl_vector_complex_set(s->f, i, gsl_complex_rect(f[i], 0));
        for (size_t j = 0; j < n; j++)
            gsl_matrix_set(s->A, i, j, A[i * n + j]);
    }
    if (gsl_eigen_nonsymmv(s->A, s->lambda, s->V, s->work) != GSL_SUCCESS)
        return qdot_fail(QDOT_EFAILED, "the eigenvectors were not found");
    for (size_t k = 0; k < n; k++) {
        lambda[k] = complex_of_gsl(gsl_vector_complex_get(s->lambda, k));
        for (size_t i = 0; i < n; i++)
            v[k * n + i] = complex_of_gsl(gsl_matrix_complex_get(s->V, i, k));
    }
    if (gsl_linalg_complex_LU_decomp(s->V, s->order, &sign) != GSL_SUCCESS
        || gsl_linalg_complex_LU_solve(s->V, s->order, s->f, s->c) != GSL_SUCCESS)
        return qdot_fail(QDOT_EFAILED, "the eigenvectors do not span the space");
    for (size_t k = 0; k < n; k++)
        c[k] = complex_of_gsl(gsl_vector_complex_get(s->c, k));
    return QDOT_OK;
}

qdot_status
qdot_eigenmodes(size_t n, const double *A, const double *f, double complex *lambda,
                double complex *v, double complex *c)
{
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    solver s = {0};
    qdot_status status =
        eigenmodes_allocate(&s, n) ? eigenmodes_solve(&s, n, A, f, lambda, v, c) : QDOT_ENOMEM;

    eigenmodes_release(&s);
    gsl_set_error_handler(before);
    return status;
}
