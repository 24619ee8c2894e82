/* bifurcation.c -- names of bifurcations, null vectors, and the tangents of two crossing curves. */
#include "sim/branches/bifurcation.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_linalg.h>

#include "base/memory.h"

const char *
qdot_bifurcation_name(qdot_bifurcation_kind kind)
{
    static const char *const names[] = {
        "fold",  "pitchfork",       "transcritical", "hopf", "hamiltonian hopf", "period doubling",
        "period doubling", "torus", "krein collision", "degenerate"};

    return names[kind];
}

qdot_status
qdot_null_vectors(size_t rows, size_t columns, const double *A, size_t count, double *out)
{
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    gsl_matrix *U = gsl_matrix_alloc(rows, columns), *V = gsl_matrix_alloc(columns, columns);
    gsl_vector *S = gsl_vector_alloc(columns);
    qdot_status status = U && V && S ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(U->data, A, rows * columns * sizeof *A);
        if (gsl_linalg_SV_decomp_jacobi(U, V, S) != GSL_SUCCESS)
            status = qdot_fail(QDOT_EFAILED, "singular values do not converge");
    }
    for (size_t k = 0; k < count && status == QDOT_OK; k++)
        for (size_t i = 0; i < columns; i++)
            out[k * columns + i] = gsl_matrix_get(V, i, columns - 1 - k);
    gsl_matrix_free(U);
    gsl_matrix_free(V);
    gsl_vector_free(S);
    gsl_set_error_handler(before);
    return status;
}

static void
normalise_tangent(const qdot_path *x, double *t)
{
    const double length = sqrt(qdot_path_product(x, t, t));

    for (size_t i = 0; i <= x->n; i++)
        t[i] /= length;
}

/* Find the tangents of the two curves at a crossing, into one and two [n + 1]. */
static void
find_crossing_tangents(const qdot_path *x, const double *c, const double *v, double root, double *one,
                       double *two)
{
    const size_t m = x->n + 1;
    const double q = -(c[1] + copysign(root, c[1]));

    for (size_t i = 0; i < m; i++) {
        one[i] = q * v[i] + c[0] * v[m + i];
        two[i] = c[2] * v[i] + q * v[m + i];
    }
    normalise_tangent(x, one);
    normalise_tangent(x, two);
}

bool
qdot_bifurcation_cross(const qdot_path *x, const double *c, double *v, const double *t,
                       double upright, double least, qdot_bifurcation_kind *kind, double *other)
{
    const size_t m = x->n + 1;
    const double root = c[1] * c[1] - c[0] * c[2], unit = 1 / sqrt(x->weight[m - 1]);
    double *const one = v + 2 * m, *const two = v + 3 * m;

    if (!(root > least * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2])))
        return false;
    find_crossing_tangents(x, c, v, sqrt(root), one, two);
    *kind = fmin(fabs(one[m - 1]), fabs(two[m - 1])) < upright * unit ? QDOT_PITCHFORK
                                                                      : QDOT_TRANSCRITICAL;
    memcpy(other, fabs(qdot_path_product(x, one, t)) > fabs(qdot_path_product(x, two, t)) ? two : one,
           m * sizeof *other);
    return true;
}
