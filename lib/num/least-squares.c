/* least-squares.c -- minimises a sum of squares, and computes the covariance of the result. */
#include "num/least-squares.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Relative offsets: where trust regions are left, as chi2 no longer shows what a step is good for; where the
 * search ends. How little of u a step may move. */
static const double near_offset = 1e-4, least_offset = 1e-10, least_move = 4e-16;

/* If no step helps: the gradient counts as rounding below this, relative to the change of the
 * residuals with u. */
static const double rounding = 1e-9;

/* The value given to all residuals where the model is undefined, so that no step of the search leads there. */
static const double nowhere = 1e150;

typedef struct {
    qdot_least_squares *x;
    double *at;         /* [p] the unknowns at which the residuals x->f and the Jacobian x->J were computed */
    bool known;         /* whether `at` is set */
    qdot_status status; /* a failure that ends the search */
    gsl_matrix *U, *V;  /* singular vectors of J: U [n x p], V [p x p] */
    gsl_vector *S, *work, *size, *along; /* [p] each: singular values of the Jacobian, then scratch vectors */
} search;

void
qdot_least_squares_clear(qdot_least_squares *x)
{
    qdot_free(x->f);
    x->f = x->J = x->covariance = x->left = x->undetermined = NULL;
}

/* --- the residuals of the model ----------------------------------------------------------- */

static bool
model_is_undefined(qdot_status status)
{
    return status == QDOT_EDOMAIN || status == QDOT_EFAILED || status == QDOT_ESINGULAR
           || status == QDOT_EINVAL || status == QDOT_ELIMIT;
}

static bool
all_are_finite(size_t n, const double *x)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += 0 * x[i];
    return sum == 0;
}

/* Evaluate the residuals x->f and their Jacobian x->J at u. */
static qdot_status
evaluate_model(search *s, const double *u)
{
    qdot_least_squares *x = s->x;
    qdot_status status;

    if (s->known && memcmp(s->at, u, x->p * sizeof *u) == 0)
        return QDOT_OK;
    s->known = false;
    memcpy(s->at, u, x->p * sizeof *u);
    x->models++;
    status = x->model(u, x->f, x->J, x->user);
    if (status == QDOT_OK && !(all_are_finite(x->n, x->f) && all_are_finite(x->n * x->p, x->J)))
        status = qdot_fail(QDOT_EFAILED, "the numbers to be fitted are not finite");
    s->known = status == QDOT_OK;
    return status;
}

static int
residuals_for_gsl(const gsl_vector *u, void *user, gsl_vector *f)
{
    search *s = user;
    const qdot_status status = evaluate_model(s, u->data);

    if (status != QDOT_OK && !model_is_undefined(status)) {
        s->status = status;
        return GSL_EFAILED;
    }
    for (size_t i = 0; i < s->x->n; i++)
        gsl_vector_set(f, i, status == QDOT_OK ? s->x->f[i] : nowhere);
    return GSL_SUCCESS;
}

static int
gsl_J(const gsl_vector *u, void *user, gsl_matrix *J)
{
    search *s = user;
    const qdot_status status = evaluate_model(s, u->data);

    if (status != QDOT_OK) {
        s->status = status;
        return GSL_EFAILED;
    }
    for (size_t i = 0; i < s->x->n; i++)
        memcpy(J->data + i * J->tda, s->x->J + i * s->x->p, s->x->p * sizeof *J->data);
    return GSL_SUCCESS;
}

/* --- singular values: J = U S V^T with columns of length 1 ----------------------------------- */

static qdot_status
decompose_jacobian(search *s)
{
    const qdot_least_squares *x = s->x;

    for (size_t k = 0; k < x->p; k++) {
        const gsl_vector_const_view column =
            gsl_vector_const_view_array_with_stride(x->J + k, x->p, x->n);
        const double size = gsl_blas_dnrm2(&column.vector);

        gsl_vector_set(s->size, k, size > 0 ? size : 1);
        for (size_t i = 0; i < x->n; i++)
            gsl_matrix_set(s->U, i, k, x->J[i * x->p + k] / gsl_vector_get(s->size, k));
    }
    return gsl_linalg_SV_decomp(s->U, s->V, s->S, s->work) == GSL_SUCCESS
               ? QDOT_OK
               : qdot_fail(QDOT_EFAILED, "the slopes have no singular values");
}

/* |U^T f| / |f|, the part of the residuals that a step could still reduce. */
static double
reducible_part(search *s)
{
    const gsl_vector_const_view f = gsl_vector_const_view_array(s->x->f, s->x->n);

    gsl_blas_dgemv(CblasTrans, 1, s->U, &f.vector, 0, s->along);
    return gsl_blas_dnrm2(s->along) / fmax(gsl_blas_dnrm2(&f.vector), 1e-300);
}

/* Compute the Gauss-Newton step C J^T f that remains at the present u, into x->left. */
static void
compute_remaining_step(const search *s)
{
    const qdot_least_squares *x = s->x;

    for (size_t i = 0; i < x->p; i++) {
        x->left[i] = 0;
        for (size_t k = 0; k < x->p; k++)
            if (gsl_vector_get(s->S, k) > x->least * gsl_vector_get(s->S, 0))
                x->left[i] += gsl_matrix_get(s->V, i, k) * gsl_vector_get(s->along, k)
                              / gsl_vector_get(s->S, k) / gsl_vector_get(s->size, i);
    }
}

/* Compute the covariance C = D V S^-2 V^T D, the remaining step D V S^-1 U^T f (D = 1/size), an undetermined direction. */
static void
compute_covariance(search *s)
{
    qdot_least_squares *x = s->x;
    const size_t p = x->p;
    const bool lost = !(gsl_vector_get(s->S, p - 1) > x->least * gsl_vector_get(s->S, 0));

    (void)reducible_part(s);
    for (size_t i = 0; i < p; i++) {
        for (size_t j = 0; j < p; j++) {
            double sum = lost ? NAN : 0;

            for (size_t k = 0; k < p; k++)
                sum += gsl_matrix_get(s->V, i, k) * gsl_matrix_get(s->V, j, k)
                       / (gsl_vector_get(s->S, k) * gsl_vector_get(s->S, k));
            x->covariance[i * p + j] =
                sum / gsl_vector_get(s->size, i) / gsl_vector_get(s->size, j);
        }
    }
    compute_remaining_step(s);
    for (size_t i = 0, most = 0; i < p && lost; i++) {
        if (fabs(gsl_matrix_get(s->V, i, p - 1)) > fabs(gsl_matrix_get(s->V, most, p - 1)) + 1e-9)
            most = i;
        if (i + 1 == p)
            for (size_t k = 0; k < p; k++)
                x->undetermined[k] =
                    copysign(1, gsl_matrix_get(s->V, most, p - 1)) * gsl_matrix_get(s->V, k, p - 1);
    }
}

/* --- the search for the minimum -------------------------------------------------------------- */

/* Whether the last step moved the unknowns u [p] by no more than rounding errors. */
static bool
has_stopped_moving(const search *s, const gsl_vector *move, const gsl_vector *u)
{
    for (size_t k = 0; k < s->x->p; k++)
        if (fabs(gsl_vector_get(move, k)) > least_move * fabs(gsl_vector_get(u, k)))
            return false;
    return true;
}

/* Whether the remaining step is rounding error, judged by the changes of the residuals that it causes. */
static bool
step_is_rounding_error(const search *s)
{
    double most = 0;

    for (size_t k = 0; k < s->x->p; k++)
        most = fmax(most, gsl_vector_get(s->size, k) * fabs(s->x->u[k]));
    return gsl_blas_dnrm2(s->along) <= rounding * most;
}

/* Take Gauss-Newton steps as long as each of them reduces the part of the residuals that can be reduced. */
static qdot_status
take_gauss_newton_steps(search *s)
{
    qdot_least_squares *x = s->x;
    double before = reducible_part(s);

    x->converged = true;
    while (before > least_offset && x->steps++ < 2 * x->most_steps) {
        compute_remaining_step(s);
        for (size_t k = 0; k < x->p; k++)
            x->u[k] -= x->left[k];
        QDOT_TRY(evaluate_model(s, x->u));
        QDOT_TRY(decompose_jacobian(s));
        if (!(reducible_part(s) < before)) {
            for (size_t k = 0; k < x->p; k++)
                x->u[k] += x->left[k];
            QDOT_TRY(evaluate_model(s, x->u));
            return decompose_jacobian(s);
        }
        before = reducible_part(s);
    }
    return QDOT_OK;
}

/* Iterate until the search ends; x->u, x->f and x->J are then those of its last point. */
static qdot_status
iterate_search(search *s, gsl_multifit_nlinear_workspace *w)
{
    qdot_least_squares *x = s->x;
    bool over = false;
    int code = GSL_SUCCESS;

    while (true) {
        memcpy(x->u, gsl_multifit_nlinear_position(w)->data, x->p * sizeof *x->u);
        QDOT_TRY(evaluate_model(s, x->u)); /* evaluate again: does nothing unless the last step was rejected */
        QDOT_TRY(decompose_jacobian(s));
        /* an unknown that is 0 at a perfect fit becomes smaller without end: the steps are used up, and the last is no more than rounding */
        x->converged = (over || x->steps == x->most_steps) && step_is_rounding_error(s);
        if (reducible_part(s) <= near_offset)
            return take_gauss_newton_steps(s);
        if (over || x->steps == x->most_steps)
            return QDOT_OK;
        code = gsl_multifit_nlinear_iterate(w);
        if (s->status != QDOT_OK)
            return s->status;
        if (code != GSL_SUCCESS && code != GSL_ENOPROG)
            return qdot_fail(QDOT_EFAILED, "the search stopped: %s", gsl_strerror(code));
        x->steps++;
        over = code == GSL_ENOPROG || has_stopped_moving(s, w->dx, w->x);
    }
}

static qdot_status
run_search(search *s)
{
    qdot_least_squares *x = s->x;
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf model = {
        .f = residuals_for_gsl, .df = gsl_J, .n = x->n, .p = x->p, .params = s};
    const gsl_vector_view u = gsl_vector_view_array(x->u, x->p);
    gsl_multifit_nlinear_workspace *w;
    qdot_status status;

    QDOT_TRY(evaluate_model(s, x->u)); /* the model must have finite values at the start */
    how.scale = gsl_multifit_nlinear_scale_more;
    how.solver = gsl_multifit_nlinear_solver_svd;
    w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, x->n, x->p);
    if (!w)
        return QDOT_ENOMEM;
    status = gsl_multifit_nlinear_init(&u.vector, &model, w) == GSL_SUCCESS
                 ? QDOT_OK
                 : qdot_fail(QDOT_EFAILED, "the squares have no finite sum");
    if (status == QDOT_OK)
        status = iterate_search(s, w);
    gsl_multifit_nlinear_free(w);
    if (status == QDOT_OK)
        compute_covariance(s);
    for (size_t i = 0; i < x->n && status == QDOT_OK; i++)
        x->chi2 += x->f[i] * x->f[i];
    return status;
}

static bool
allocate_search(search *s)
{
    qdot_least_squares *x = s->x;
    const size_t n = x->n, p = x->p;

    x->f = qdot_calloc(n + n * p + p * p + 2 * p + 1, sizeof *x->f);
    s->at = qdot_calloc(p, sizeof *s->at);
    s->U = gsl_matrix_alloc(n, p);
    s->V = gsl_matrix_alloc(p, p);
    s->S = gsl_vector_alloc(p);
    s->work = gsl_vector_alloc(p);
    s->size = gsl_vector_alloc(p);
    s->along = gsl_vector_alloc(p);
    if (!x->f)
        return false;
    x->J = x->f + n;
    x->covariance = x->J + n * p;
    x->left = x->covariance + p * p;
    x->undetermined = x->left + p;
    return s->at && s->U && s->V && s->S && s->work && s->size && s->along;
}

qdot_status
qdot_least_squares_find(qdot_least_squares *x)
{
    search s = {.x = x};
    qdot_status status;

    if (x->n < x->p || x->p == 0)
        return qdot_fail(QDOT_EINVAL, "%zu numbers do not determine %zu unknowns", x->n, x->p);
    gsl_set_error_handler_off();
    x->least = x->least > 0 ? x->least : 1e-10;
    x->most_steps = x->most_steps > 0 ? x->most_steps : 200;
    x->steps = x->models = 0;
    x->chi2 = 0;
    status = allocate_search(&s) ? run_search(&s) : QDOT_ENOMEM;
    gsl_matrix_free(s.U);
    gsl_matrix_free(s.V);
    gsl_vector_free(s.S);
    gsl_vector_free(s.work);
    gsl_vector_free(s.size);
    gsl_vector_free(s.along);
    qdot_free(s.at);
    return status;
}
