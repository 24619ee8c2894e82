/* eigenvalues.c -- eigenvalues and their errors, by GSL. */
#include "num/eigenvalues.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include <complex.h> /* after GSL's headers, so that GSL keeps its own complex type */

#include "base/memory.h"

typedef struct {
    size_t n;
    gsl_matrix *A;
    /* right eigenvectors as columns; LU factors of V; left eigenvectors as rows of V^-1 */
    gsl_matrix_complex *V, *LU, *W;
    gsl_vector_complex *lambda, *mu; /* [n] eigenvalues of the matrix A; eigenvalues of its transpose */
    gsl_permutation *order;
    gsl_eigen_nonsymmv_workspace *work;
    double complex *planes; /* [4n] vectors that span two invariant planes */
} solver;

static bool
eigenvalues_allocate(solver *s)
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
    s->planes = qdot_calloc(4 * n + 1, sizeof *s->planes);
    return s->planes && s->A && s->V && s->LU && s->W && s->lambda && s->mu && s->order && s->work;
}

static void
eigenvalues_release(solver *s)
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
    qdot_free(s->planes);
}

/* A bound of |w_k (error of A) v_m|, from the errors E of the entries and rounding in A. */
static double
error_between(const solver *s, const double *A, const double *E, size_t k, size_t m)
{
    const size_t n = s->n;
    double sum = 0, size = 0;

    for (size_t i = 0; i < n * n; i++)
        size = fmax(size, fabs(A[i]));
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            sum += gsl_complex_abs(gsl_matrix_complex_get(s->W, k, i)) *
                   (E[i * n + j] + 4 * DBL_EPSILON * size) *
                   gsl_complex_abs(gsl_matrix_complex_get(s->V, j, m));
    return sum;
}

/* Left vectors that are found by themselves: V^-1 is lost to all where two other eigenvalues are one with one
 * vector. */
static void
find_left_vectors(solver *s, const double *A)
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
    }
}

/* Component i of the right eigenvector v_k; the next function: of the left eigenvector w_k. */
static double complex
right_component(const solver *s, size_t k, size_t i)
{
    const gsl_complex x = gsl_matrix_complex_get(s->V, i, k);

    return GSL_REAL(x) + I * GSL_IMAG(x);
}

static double complex
left_component(const solver *s, size_t k, size_t i)
{
    const gsl_complex x = gsl_matrix_complex_get(s->W, k, i);

    return GSL_REAL(x) + I * GSL_IMAG(x);
}

/* Orthonormal q_0, q_1, columns of Q, in the plane of v_k and v_j, and L, the rows dual to them in the plane of w_k and
 * w_j. Whether both are planes. */
static bool
find_invariant_planes(const solver *s, size_t k, size_t j, double complex *Q, double complex *L)
{
    const size_t n = s->n;
    double complex along = 0, G[4] = {0}, det;
    double size = 0;

    for (size_t i = 0; i < n; i++) { /* use that GSL's eigenvectors have length 1 */
        Q[2 * i] = right_component(s, k, i);
        along += conj(Q[2 * i]) * right_component(s, j, i);
    }
    for (size_t i = 0; i < n; i++) {
        Q[2 * i + 1] = right_component(s, j, i) - along * Q[2 * i];
        size = hypot(size, cabs(Q[2 * i + 1]));
    }
    for (size_t i = 0; i < n && size > 0; i++)
        Q[2 * i + 1] /= size;
    for (size_t i = 0; i < n; i++)
        for (int m = 0; m < 2; m++) {
            G[m] += left_component(s, k, i) * Q[2 * i + m];
            G[2 + m] += left_component(s, j, i) * Q[2 * i + m];
        }
    det = G[0] * G[3] - G[1] * G[2];
    for (size_t i = 0; i < n; i++) {
        L[i] = (G[3] * left_component(s, k, i) - G[1] * left_component(s, j, i)) / det;
        L[n + i] = (G[0] * left_component(s, j, i) - G[2] * left_component(s, k, i)) / det;
    }
    return size > 0 && isfinite(cabs(det)) && cabs(det) > 0;
}

/* The change of eigenvalue k by the errors E of A within the plane of the eigenvectors k and j. */
static double
error_in_plane(const solver *s, const double *A, const double *E, const double complex *Q, const double complex *L)
{
    const size_t n = s->n;
    double e[4] = {0}, size = 0;
    double complex coupling = 0;

    for (size_t i = 0; i < n * n; i++)
        size = fmax(size, fabs(A[i]));
    for (size_t i = 0; i < n; i++)
        for (size_t m = 0; m < n; m++) {
            coupling += conj(Q[2 * i]) * A[i * n + m] * Q[2 * m + 1];
            for (int a = 0; a < 4; a++)
                e[a] += cabs(L[a / 2 * n + i]) * (E[i * n + m] + 4 * DBL_EPSILON * size) * cabs(Q[2 * m + a % 2]);
        }
    return fmax(e[0], e[3]) + 2 * sqrt(e[2] * (cabs(coupling) + e[1]));
}

static double
eigenvalue_distance(const solver *s, size_t j, size_t k)
{
    return gsl_complex_abs(gsl_complex_sub(gsl_vector_complex_get(s->lambda, j), gsl_vector_complex_get(s->lambda, k)));
}

/* Lower the error bounds of eigenvalues by the left eigenvectors where these give smaller ones. */
static void
lower_error_bounds(const solver *s, const double *A, const double *E, double *error)
{
    double complex *const Q = s->planes, *const L = s->planes + 2 * s->n;

    for (size_t k = 0; k < s->n; k++) {
        const double first = error_between(s, A, E, k, k);
        double sum = first;

        for (size_t j = 0; j < s->n; j++) {
            double both;

            if (j == k || !(eigenvalue_distance(s, j, k) <= 16 * first))
                continue;
            both = error_between(s, A, E, k, j) * error_between(s, A, E, j, k);
            sum += 4 * sqrt(both) < eigenvalue_distance(s, j, k) ? 4 * both / eigenvalue_distance(s, j, k) : sqrt(both);
            if (find_invariant_planes(s, k, j, Q, L))
                error[k] = fmin(error[k], error_in_plane(s, A, E, Q, L));
        }
        error[k] = fmin(error[k], sum);
    }
}

static double
modulus(const double *re, const double *im, size_t k)
{
    return hypot(re[k], im[k]);
}

/* Whether the moduli of eigenvalues j and k are equal within their errors. */
static bool
is_as_large(const double *re, const double *im, const double *error, size_t j, size_t k)
{
    const double size = modulus(re, im, j), rounding = 16 * DBL_EPSILON * size;
    const double both = error[j] + error[k];

    return fabs(size - modulus(re, im, k)) <= fmax(2 * both, rounding);
}

static void
exchange_numbers(double *x, size_t j, size_t k)
{
    const double kept = x[j];

    x[j] = x[k];
    x[k] = kept;
}

/* Sort first..end-1 by insertion; `before` tells whether k must come before j. */
static void
eigenvalues_sort(size_t first, size_t end, bool (*before)(const double *re, const double *im, size_t k, size_t j),
                 double *re, double *im, double *error)
{
    for (size_t i = first + 1; i < end; i++)
        for (size_t k = i; k > first && before(re, im, k, k - 1); k--) {
            exchange_numbers(re, k, k - 1);
            exchange_numbers(im, k, k - 1);
            exchange_numbers(error, k, k - 1);
        }
}

static bool
has_larger_modulus(const double *re, const double *im, size_t k, size_t j)
{
    return modulus(re, im, k) > modulus(re, im, j);
}

static bool
has_larger_real_part(const double *re, const double *im, size_t k, size_t j)
{
    return re[k] > re[j] || (re[k] == re[j] && im[k] > im[j]);
}

void
qdot_eigenvalues_arrange(size_t n, double *re, double *im, double *error)
{
    eigenvalues_sort(0, n, has_larger_modulus, re, im, error);
    for (size_t first = 0, end; first < n; first = end) {
        for (end = first + 1; end < n && is_as_large(re, im, error, end - 1, end);)
            end++;
        eigenvalues_sort(first, end, has_larger_real_part, re, im, error);
    }
}

static qdot_status
eigenvalues_solve(solver *s, const double *A, const double *E, double *re, double *im, double *error)
{
    const size_t n = s->n;
    int sign;

    for (size_t i = 0; i < n * n; i++)
        gsl_matrix_set(s->A, i / n, i % n, A[i]);
    if (gsl_eigen_nonsymmv(s->A, s->lambda, s->V, s->work) != GSL_SUCCESS)
        return qdot_fail(QDOT_EFAILED, "the eigenvalues were not found");
    (void)gsl_matrix_complex_memcpy(s->LU, s->V);
    const bool known =
        gsl_linalg_complex_LU_decomp(s->LU, s->order, &sign) == GSL_SUCCESS &&
        gsl_linalg_complex_LU_invert(s->LU, s->order, s->W) == GSL_SUCCESS;

    for (size_t k = 0; k < n; k++) {
        re[k] = GSL_REAL(gsl_vector_complex_get(s->lambda, k));
        im[k] = GSL_IMAG(gsl_vector_complex_get(s->lambda, k));
        error[k] = NAN;
    }
    if (known)
        lower_error_bounds(s, A, E, error);
    else
        gsl_matrix_complex_set_all(s->W, gsl_complex_rect(NAN, NAN));
    find_left_vectors(s, A);
    lower_error_bounds(s, A, E, error);
    qdot_eigenvalues_arrange(n, re, im, error);
    return QDOT_OK;
}

qdot_status
qdot_eigenvalues(size_t n, const double *A, const double *E, double *re, double *im,
                 double *error)
{
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    solver s = {.n = n};
    qdot_status status = eigenvalues_allocate(&s) ? eigenvalues_solve(&s, A, E, re, im, error) : QDOT_ENOMEM;

    eigenvalues_release(&s);
    gsl_set_error_handler(before);
    return status;
}

/* --- eigenvalues of products of matrices --------------------------------------------------------- */

/* Raise [count] numbers to the K-th power, with their errors. */
static void
raise_to_power(size_t K, size_t count, double *re, double *im, double *error)
{
    for (size_t i = 0; i < count; i++) {
        const double size = modulus(re, im, i), angle = (double)K * atan2(im[i], re[i]);
        const double power = pow(size, (double)K);

        error[i] = pow(size + error[i], (double)K) - power + (double)K * DBL_EPSILON * power;
        re[i] = power * cos(angle);
        im[i] = power * sin(angle);
    }
}

/* The index of the number nearest to (x, y) among those not taken yet; n if none is left. */
static size_t
find_nearest(double x, double y, size_t n, const double *re, const double *im, const bool *taken)
{
    size_t best = n;

    for (size_t i = 0; i < n; i++)
        if (!taken[i] && (best == n || hypot(re[i] - x, im[i] - y) < hypot(re[best] - x, im[best] - y)))
            best = i;
    return best;
}

/* Take the K numbers nearest to (x, y): their mean *re, *im; *error: theirs, and how far they are from it. Whether what is
 * nearest to the conjugate (x, -y) is among them: then they are one real number. */
static bool
take_cluster(size_t K, size_t n, const double *all, bool *taken, size_t *own, double x, double y, double *re,
             double *im, double *error)
{
    const double *const a = all, *const b = all + n, *const off = all + 2 * n;
    const size_t mate = find_nearest(x, -y, n, a, b, taken);
    bool real = false;

    *re = *im = *error = 0;
    for (size_t k = 0; k < K; k++) {
        const size_t i = own[k] = find_nearest(x, y, n, a, b, taken);

        taken[i] = true;
        real = real || i == mate;
        *re += a[i] / (double)K;
        *im += b[i] / (double)K;
    }
    *im = real ? 0 : *im;
    for (size_t k = 0; k < K; k++)
        *error = fmax(*error, off[own[k]] + hypot(a[own[k]] - *re, (real ? 0 : b[own[k]]) - *im));
    return real;
}

/* Find n numbers, each of which occurs K times in all [3 x K n] (re, im, error), sorted by modulus. */
static void
find_cluster_means(size_t K, size_t n, const double *all, bool *taken, size_t *own, double *re, double *im, double *error)
{
    const size_t count = K * n;

    for (size_t i = 0, first = 0; i < n; i++) {
        while (taken[first])
            first++;
        if (take_cluster(K, count, all, taken, own, all[first], all[count + first], &re[i], &im[i], &error[i]) ||
            i + 1 == n)
            continue;
        (void)take_cluster(K, count, all, taken, own, re[i], -im[i], &re[i + 1], &im[i + 1], &error[i + 1]);
        re[i + 1] = re[i];
        im[i + 1] = -im[i];
        error[i + 1] = fmax(error[i], error[i + 1]);
        i++;
    }
}

qdot_status
qdot_eigenvalues_of_product(size_t K, size_t n, const double *A, const double *E, double *re, double *im,
                            double *error)
{
    const size_t count = K * n;
    double *C, *D, *all;
    size_t *own;
    bool *taken;
    qdot_status status = QDOT_ENOMEM;

    if (K == 1)
        return qdot_eigenvalues(n, A, E, re, im, error);
    C = qdot_calloc(2 * count * count + 3 * count, sizeof *C);
    own = qdot_calloc(K, sizeof *own);
    taken = qdot_calloc(count, sizeof *taken);
    if (C && own && taken) {
        D = C + count * count;
        all = D + count * count;
        for (size_t k = 0; k < K; k++)
            for (size_t i = 0; i < n * n; i++) {
                const size_t at = ((k + 1) % K * n + i / n) * count + k * n + i % n;

                C[at] = A[k * n * n + i];
                D[at] = E[k * n * n + i];
            }
        status = qdot_eigenvalues(count, C, D, all, all + count, all + 2 * count);
    }
    if (status == QDOT_OK) {
        raise_to_power(K, count, all, all + count, all + 2 * count);
        find_cluster_means(K, n, all, taken, own, re, im, error);
        qdot_eigenvalues_arrange(n, re, im, error);
    }
    qdot_free(C);
    qdot_free(own);
    qdot_free(taken);
    return status;
}
