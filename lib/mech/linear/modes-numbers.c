/* modes-numbers.c -- normal modes in numbers, part by part as exact ones. */
#include "mech/linear/modes-parts.h"

#include <math.h>

#include <gsl/gsl_eigen.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"

typedef struct {
    qdot_modes_job *j;
    double *M, *Gamma, *H, *N; /* of the whole linear motion */
    const qdot_expr *exact;    /* M, Gamma, H with the values of the session */
    double scale;              /* about the largest square of a frequency in the set of unknowns at work */
} numbers;

/* Put the session's values into e [n], to bound [n], and evaluate these; QDOT_EUNSET names a parameter without one. */
static qdot_status
evaluate_with_values(const qdot_modes_job *j, size_t n, const qdot_expr *e, qdot_expr *bound, double *out)
{
    qdot_pool *pool = j->pool;
    qdot_expr list = qdot_modes_bound(j, qdot_list(pool, (uint32_t)n, e)), atoms;

    QDOT_TRY(qdot_pool_check(pool));
    atoms = qdot_expr_atoms(pool, list, true);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_is_class(pool, x, QDOT_CONST))
            continue;
        qdot_fail(QDOT_EUNSET,
                  "the modes cannot be found exactly; numbers need a value of `%.100s`",
                  qdot_expr_kind(pool, x) == QDOT_SYM
                      ? qdot_expr_symbol(pool, x)->name
                      : qdot_ufun_get(pool, qdot_expr_node(pool, x)->op)->name);
        return qdot_hint("set %.100s = ...", qdot_expr_kind(pool, x) == QDOT_SYM
                                                 ? qdot_expr_symbol(pool, x)->name
                                                 : "f(...)");
    }
    for (size_t i = 0; i < n; i++)
        bound[i] = qdot_expr_arg(pool, list, (uint32_t)i);
    return qdot_generic_evaluate(pool, n, bound, NULL, out);
}

/* x is scaled so that the first component that is not small is 1; one that is not real is a list [re, im]. */
qdot_status
qdot_modes_add_numbers(qdot_modes_job *j, double w, const double *N, const double *re, const double *im)
{
    const size_t n = j->s->coordinates.n, m = j->m.n;
    double *x = qdot_calloc(2 * n, sizeof *x), *y = x + n, most = 0, a = 0, b = 0;
    qdot_status status = x == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        for (size_t k = 0; k < m; k++) {
            x[i] += N[i * m + k] * re[k];
            y[i] += N[i * m + k] * (im == NULL ? 0 : im[k]);
        }
        most = fmax(most, hypot(x[i], y[i]));
    }
    if (status == QDOT_OK)
        status = qdot_vec_push(&j->frequency, qdot_generic_decimal(j->pool, w));
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        double u = 0, v = 0;
        qdot_expr part[2];

        if (a == 0 && b == 0 && hypot(x[i], y[i]) > 1e-9 * most) {
            a = x[i];
            b = y[i];
        }
        if (a != 0 || b != 0) {
            u = b == 0 ? x[i] / a : (x[i] * a + y[i] * b) / (a * a + b * b);
            v = b == 0 ? y[i] / a : (y[i] * a - x[i] * b) / (a * a + b * b);
        }
        part[0] = qdot_generic_decimal(j->pool, fabs(u) * hypot(a, b) > 1e-12 * most ? u : 0);
        part[1] = qdot_generic_decimal(j->pool, fabs(v) * hypot(a, b) > 1e-12 * most ? v : 0);
        status = qdot_vec_push(&j->amplitude, part[1] == QDOT_ZERO ? part[0] : qdot_list(j->pool, 2, part));
    }
    qdot_free(x);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* out [n x n] = B^T X B: M or H of the part, X that of all unknowns. */
static void
project_numbers_on_part(const qdot_modes_part *part, const double *X, gsl_matrix *out)
{
    const size_t n = part->n, whole = part->whole;

    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++) {
            double sum = 0;

            for (size_t i = 0; i < whole; i++)
                for (size_t k = 0; k < whole && part->B[i * n + a] != 0; k++)
                    sum += part->B[i * n + a] * part->B[k * n + b] * X[i * whole + k];
            gsl_matrix_set(out, a, b, sum);
        }
}

static qdot_status
add_vectors_of_part(const numbers *x, const qdot_modes_part *part, const gsl_vector *W, const gsl_matrix *Z)
{
    const size_t n = part->n;
    const double scale = fmax(x->scale, fmax(fabs(gsl_vector_get(W, 0)), fabs(gsl_vector_get(W, n - 1))));
    double *y = qdot_calloc(part->whole + 1, sizeof *y);
    qdot_status status = y == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        const double square = gsl_vector_get(W, k);

        for (size_t i = 0; i < part->whole; i++) {
            y[i] = 0;
            for (size_t a = 0; a < n; a++)
                y[i] += part->B[i * n + a] * gsl_matrix_get(Z, a, k);
        }
        status = square < -1e-10 * scale
                     ? qdot_modes_fail_unstable()
                     : qdot_modes_add_numbers(x->j, sqrt(square > 1e-13 * scale ? square : 0), x->N, y, NULL);
    }
    qdot_free(y);
    return status;
}

static qdot_status
find_numbers_of_part(void *user, const qdot_modes_part *part, bool *go_on)
{
    const numbers *x = user;
    const size_t n = part->n;
    gsl_matrix *H = gsl_matrix_alloc(n, n), *M = gsl_matrix_alloc(n, n), *Z = gsl_matrix_alloc(n, n);
    gsl_vector *W = gsl_vector_alloc(n);
    gsl_eigen_gensymmv_workspace *work = gsl_eigen_gensymmv_alloc(n);
    qdot_status status = H == NULL || M == NULL || Z == NULL || W == NULL || work == NULL ? QDOT_ENOMEM : QDOT_OK;

    *go_on = true;
    if (status == QDOT_OK) {
        project_numbers_on_part(part, x->M, M);
        project_numbers_on_part(part, x->H, H);
        if (gsl_eigen_gensymmv(H, M, W, Z, work) != GSL_SUCCESS)
            status = qdot_fail(QDOT_ESINGULAR, "the mass matrix is not positive definite there");
    }
    if (status == QDOT_OK) {
        gsl_eigen_gensymmv_sort(W, Z, GSL_EIGEN_SORT_VAL_ASC);
        status = add_vectors_of_part(x, part, W, Z);
    }
    gsl_matrix_free(H);
    gsl_matrix_free(M);
    gsl_matrix_free(Z);
    gsl_vector_free(W);
    if (work != NULL)
        gsl_eigen_gensymmv_free(work);
    return status;
}

static qdot_status
find_numbers_of_set(void *user, size_t n, const size_t *which, bool *done)
{
    numbers *x = user;
    const size_t m = x->j->m.n;

    *done = true;
    x->scale = 0;
    for (size_t i = 0; i < n; i++) {
        const size_t at = which[i] * (m + 1);

        x->scale = fmax(x->scale, fabs(x->H[at] / x->M[at]));
    }
    return qdot_modes_split(x->j, n, which, x->exact, x->exact + 2 * m * m, find_numbers_of_part, x);
}

static qdot_status
find_symmetric_numbers(numbers *x)
{
    const size_t m = x->j->m.n;
    bool done;

    return qdot_modes_for_sets(m, x->exact, x->exact + 2 * m * m, find_numbers_of_set, x, &done);
}

qdot_status
qdot_modes_in_numbers(qdot_modes_job *j)
{
    const size_t m = j->m.n, all = 3 * m * m + j->s->coordinates.n * m;
    qdot_expr *bound = qdot_calloc(all + 1, sizeof *bound);
    double *v = qdot_calloc(all + 1, sizeof *v);
    numbers x = {.j = j, .exact = bound, .M = v, .Gamma = v + m * m, .H = v + 2 * m * m, .N = v + 3 * m * m};
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    qdot_status status = v == NULL || bound == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK) /* the arrays M, Gamma, H, N follow each other in memory */
        status = evaluate_with_values(j, all, j->m.M, bound, v);
    if (status == QDOT_OK)
        status = j->symmetric && !j->gyroscopic ? find_symmetric_numbers(&x)
                                                : qdot_modes_gyroscopic_numbers(j, x.M, x.Gamma, x.H, x.N);
    j->numeric = true;
    gsl_set_error_handler(before);
    qdot_free(v);
    qdot_free(bound);
    return status;
}
