/* stability-numbers.c -- whether a scene stays near a place that is known in numbers.
 *
 * Such a place was proved with all slopes of its equations (normal/solve/isolate.h), so that the constraints have
 * full rank there and H, in their tangent space, is not singular. What counts is asked of eigenvalues with
 * a margin that rounding does not reach; within it, nothing is said. */
#include <math.h>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/linear/linear-motion.h"
#include "mech/study/stability.h"

/* Of the largest entry: below SMALL is 0. Roots with real parts beyond AWAY of the fastest
 * count as growing: multiple ones scatter by the fourth root of rounding. Beyond ALONE, where all
 * differ. */
static const double SMALL = 1e-9, AWAY = 1e-3, ALONE = 1e-5, DECAYS = 1e-6;

struct qdot_stability_numbers {
    qdot_scene *s;
    size_t n, c;    /* numbers of coordinates and constraints */
    qdot_expr *e;   /* expressions M, Gamma, H [n * n] each, then A = df/dq [c * n] */
    bool damped;    /* whether the damping matrix Gamma is defined at rest */
    bool *told;     /* [n] whether the coordinate occurs in an equation at rest */
    size_t m;       /* number of symbols: q, q', q'', multipliers, then the free parameter */
    qdot_expr *symbol;
    double *at, *value;
};

qdot_status
qdot_stability_numbers_new(const qdot_judge *judge, qdot_stability_numbers **out)
{
    qdot_scene *s = judge->s;
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n, c = s->constraints.n, count = 3 * n * n + c * n;
    qdot_stability_numbers *x = qdot_calloc(1, sizeof *x);
    qdot_status status = QDOT_OK;

    *out = NULL;
    if (x == NULL)
        return QDOT_ENOMEM;
    *x = (qdot_stability_numbers){
        .s = s, .n = n, .c = c, .m = 3 * n + c + (judge->parameter != QDOT_NIL)};
    x->e = qdot_calloc(count + x->m + 1, sizeof *x->e);
    x->value = qdot_calloc(count + x->m + 1, sizeof *x->value);
    x->told = qdot_calloc(n + 1, sizeof *x->told);
    if (x->e == NULL || x->value == NULL || x->told == NULL)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_expr left = qdot_motion_residual(s, i);

        status = qdot_pool_check(pool);
        if (status != QDOT_OK)
            break;
        for (uint32_t order = 0; order < 3; order++)
            for (size_t j = 0; j < n; j++)
                x->e[(2 - order) * n * n + i * n + j] =
                    qdot_diff(pool, left, qdot_mech_jet(s, j, order));
        for (size_t k = 0; k < c; k++)
            x->e[3 * n * n + k * n + i] = qdot_integrated_slope(s, k, i);
        x->told[i] = qdot_stability_is_told(judge, i);
        status = qdot_pool_check(pool);
    }
    for (size_t i = 0; i < count && judge->bind != NULL && status == QDOT_OK; i++) {
        x->e[i] = judge->bind(judge->user, x->e[i]);
        status = qdot_pool_check(pool);
    }
    if (status != QDOT_OK) {
        qdot_stability_numbers_free(x);
        return status;
    }
    x->symbol = x->e + count;
    x->at = x->value + count;
    for (uint32_t order = 0; order < 3; order++)
        for (size_t i = 0; i < n; i++)
            x->symbol[order * n + i] = qdot_mech_jet(s, i, order);
    for (size_t k = 0; k < c; k++)
        x->symbol[3 * n + k] = s->constraints.at[k].multiplier;
    if (judge->parameter != QDOT_NIL)
        x->symbol[3 * n + c] = judge->parameter;
    *out = x;
    return QDOT_OK;
}

void
qdot_stability_numbers_free(qdot_stability_numbers *x)
{
    if (x == NULL)
        return;
    qdot_free(x->e);
    qdot_free(x->value);
    qdot_free(x->told);
    qdot_free(x);
}

/* --- the linear motion in numbers ------------------------------------------------------- */

/* The linear motion in the tangent space of the constraints: y, first those in equations at rest; scaled so that M = 1. */
typedef struct {
    size_t m, told;
    double *M, *G, *H; /* [m x m] mass, damping and stiffness matrix */
} motion;

/* Set the values of the symbols at the equilibrium. */
static qdot_status
set_equilibrium_values(qdot_stability_numbers *x, const qdot_equilibrium *e)
{
    const qdot_pool *pool = x->s->pool;

    for (size_t i = 0; i < x->m; i++) {
        x->at[i] = 0;
        for (uint32_t k = 0; k < qdot_expr_count(pool, e->equations); k++) {
            qdot_expr one = qdot_expr_arg(pool, e->equations, k),
                      value = qdot_expr_arg(pool, one, 1);

            if (qdot_expr_arg(pool, one, 0) == x->symbol[i])
                QDOT_TRY(
                    qdot_generic_evaluate(pool, 1, &value, NULL, &x->at[i]));
        }
    }
    return QDOT_OK;
}

/* Evaluate M, Gamma, H and A at the values of the symbols; *finite: false if an entry, not of Gamma, is undefined. */
static qdot_status
matrices_evaluate(qdot_stability_numbers *x, bool *finite)
{
    const qdot_pool *pool = x->s->pool;
    size_t n = x->n, count = 3 * n * n + x->c * n;

    QDOT_TRY(qdot_generic_evaluate(
        pool, count, x->e, &(qdot_generic_point){x->m, x->symbol, x->at, 1}, x->value));
    *finite = x->damped = true;
    for (size_t i = 0; i < count; i++) {
        bool gamma = i >= n * n && i < 2 * n * n;

        if (isfinite(x->value[i]))
            continue;
        x->damped = x->damped && !gamma;
        *finite = *finite && gamma;
        x->value[i] = 0;
    }
    return QDOT_OK;
}

/* Make the equations of states those of second order that linear-motion.h describes. */
static void
raise_states(const qdot_stability_numbers *x)
{
    const size_t n = x->n;
    double *M = x->value, *G = M + n * n, *H = G + n * n;

    for (size_t z = 0; z < n && x->s->states.n > 0; z++) {
        if (!qdot_scene_state_of(x->s, x->s->coordinates.at[z]))
            continue;
        for (size_t j = 0; j < n; j++) {
            const double by = G[z * n + j];

            for (size_t i = 0; i < 3 * n && j != z; i++)
                M[i * n + j] -= by * M[i * n + z];
        }
        for (size_t j = 0; j < n; j++) {
            M[z * n + j] = G[z * n + j];
            G[z * n + j] += H[z * n + j];
        }
    }
}

/* A basis of the null space of A, the told coordinates' part first: N [n * m]. Free coordinates
 * stand in no constraint. */
static bool
find_tangent_space(const qdot_stability_numbers *x, gsl_matrix *N, motion *out)
{
    size_t n = x->n, c = x->c, rank = 0, column = 0, told = 0;
    gsl_matrix *A = gsl_matrix_calloc(n + c, n), *V = gsl_matrix_alloc(n, n);
    gsl_vector *S = gsl_vector_alloc(n), *work = gsl_vector_alloc(n);
    bool fine = A != NULL && V != NULL && S != NULL && work != NULL;

    for (size_t k = 0; k < c && fine; k++)
        for (size_t i = 0; i < n; i++)
            gsl_matrix_set(A, k, i, x->value[3 * n * n + k * n + i]);
    /* add rows that separate the coordinates that do not occur in the equations at rest */
    for (size_t i = 0; i < n && fine; i++) {
        told += x->told[i];
        if (!x->told[i])
            gsl_matrix_set(A, c + i, i, 1);
    }
    fine = fine && gsl_linalg_SV_decomp(A, V, S, work) == GSL_SUCCESS;
    for (size_t i = 0; i < n && fine; i++)
        rank += gsl_vector_get(S, i) > SMALL * gsl_vector_get(S, 0);
    fine = fine && rank == c + (n - told);
    out->told = fine ? n - rank : 0;
    for (size_t k = rank; k < n && fine; k++, column++)
        for (size_t i = 0; i < n; i++)
            gsl_matrix_set(N, i, column, gsl_matrix_get(V, i, k));
    for (size_t k = 0; k < n && fine; k++)
        if (!x->told[k]) {
            for (size_t i = 0; i < n; i++)
                gsl_matrix_set(N, i, column, i == k);
            column++;
        }
    out->m = column;
    gsl_matrix_free(A);
    gsl_matrix_free(V);
    gsl_vector_free(S);
    gsl_vector_free(work);
    return fine;
}

/* Project the matrix X onto the tangent space with basis N: N^T X N, an m x m matrix. */
static void
project_matrix(const double *X, const gsl_matrix *N, size_t n, size_t m, double *out)
{
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < m; b++) {
            double sum = 0;

            for (size_t i = 0; i < n; i++)
                for (size_t k = 0; k < n; k++)
                    sum += gsl_matrix_get(N, i, a) * X[i * n + k] * gsl_matrix_get(N, k, b);
            out[a * m + b] = sum;
        }
}

static double
largest_modulus(size_t n, const double *x)
{
    double most = 0;

    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

/* Eigenvalues of the symmetric part of the leading k x k block of X [m * m], the least and the
 * greatest. */
static bool
eigenvalue_range(const double *X, size_t m, size_t k, double *least, double *most)
{
    gsl_matrix *A = gsl_matrix_alloc(k, k);
    gsl_vector *w = gsl_vector_alloc(k);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(k);
    bool fine = A != NULL && w != NULL && work != NULL;

    for (size_t a = 0; a < k && fine; a++)
        for (size_t b = 0; b < k; b++)
            gsl_matrix_set(A, a, b, (X[a * m + b] + X[b * m + a]) / 2);
    fine = fine && gsl_eigen_symm(A, w, work) == GSL_SUCCESS;
    if (fine)
        gsl_vector_minmax(w, least, most);
    gsl_matrix_free(A);
    gsl_vector_free(w);
    if (work != NULL)
        gsl_eigen_symm_free(work);
    return fine;
}

/* The largest entry of (X + sign X^T)/2, the symmetric (1) or antisymmetric (-1) part. */
static double
largest_symmetric_entry(const double *X, size_t m, int sign)
{
    double most = 0;

    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < m; b++)
            most = fmax(most, fabs(X[a * m + b] + sign * X[b * m + a]) / 2);
    return most;
}

/* Find the roots s of det(s^2 + G s + H) = 0: 2 m real and 2 m imaginary parts. */
static bool
find_characteristic_roots(const motion *x, double *re, double *im)
{
    size_t m = x->m;
    gsl_matrix *A = gsl_matrix_calloc(2 * m, 2 * m);
    gsl_vector_complex *s = gsl_vector_complex_alloc(2 * m);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(2 * m);
    bool fine = A != NULL && s != NULL && work != NULL;

    for (size_t a = 0; a < m && fine; a++) {
        gsl_matrix_set(A, a, m + a, 1);
        for (size_t b = 0; b < m; b++) {
            gsl_matrix_set(A, m + a, b, -x->H[a * m + b]);
            gsl_matrix_set(A, m + a, m + b, -x->G[a * m + b]);
        }
    }
    fine = fine && gsl_eigen_nonsymm(A, s, work) == GSL_SUCCESS;
    for (size_t k = 0; k < 2 * m && fine; k++) {
        re[k] = GSL_REAL(gsl_vector_complex_get(s, k));
        im[k] = GSL_IMAG(gsl_vector_complex_get(s, k));
    }
    gsl_matrix_free(A);
    gsl_vector_complex_free(s);
    if (work != NULL)
        gsl_eigen_nonsymm_free(work);
    return fine;
}

/* Scale the coordinates, y = L^-T z with M = L L^T, so that M = 1; false if M is not positive definite. */
static bool
normalise_mass(motion *x)
{
    size_t m = x->m;
    gsl_matrix_view M = gsl_matrix_view_array(x->M, m, m);
    double least = 0, most = 0;

    if (!eigenvalue_range(x->M, m, m, &least, &most) || least <= 1e-12 * most ||
        gsl_linalg_cholesky_decomp1(&M.matrix) != GSL_SUCCESS)
        return false;
    for (int k = 0; k < 2; k++) {
        double *X = k == 0 ? x->G : x->H;

        for (size_t b = 0; b < m; b++) /* replace X by L^-1 X, where M = L L^T */
            for (size_t a = 0; a < m; a++) {
                for (size_t i = 0; i < a; i++)
                    X[a * m + b] -= x->M[a * m + i] * X[i * m + b];
                X[a * m + b] /= x->M[a * m + a];
            }
        for (size_t a = 0; a < m; a++) /* replace X by X L^-T */
            for (size_t b = 0; b < m; b++) {
                for (size_t i = 0; i < b; i++)
                    X[a * m + b] -= x->M[b * m + i] * X[a * m + i];
                X[a * m + b] /= x->M[b * m + b];
            }
    }
    return true;
}

/* --- the verdict on stability ----------------------------------------------------------- */

static qdot_stability
stability_by_roots(const motion *x, double h, double g, bool definite)
{
    double *re = qdot_calloc(4 * x->m + 1, sizeof *re), *im, fast = fmax(sqrt(h), g);
    double decay = 0, growth = 0, gap = INFINITY, least, most;
    qdot_stability verdict = QDOT_STABILITY_UNDECIDED;

    if (re == NULL)
        return verdict;
    im = re + 2 * x->m;
    if (find_characteristic_roots(x, re, im)) {
        decay = growth = re[0];
        for (size_t i = 0; i < 2 * x->m; i++) {
            decay = fmax(decay, re[i]);
            growth = fmax(growth, re[i]);
            for (size_t k = 0; k < i; k++)
                gap = fmin(gap, hypot(re[i] - re[k], im[i] - im[k]));
        }
        if (growth > AWAY * fast || (growth > ALONE * fast && gap > AWAY * fast))
            verdict = QDOT_UNSTABLE;
        else if (x->told == x->m && decay < -DECAYS * fast)
            verdict = QDOT_STABLE;
        else if (x->told == x->m && largest_symmetric_entry(x->G, x->m, 1) <= SMALL * fast &&
                 fabs(growth) < SMALL * fast && gap > AWAY * fast)
            verdict = QDOT_STABLE_TO_FIRST_ORDER;
    }
    if (verdict == QDOT_STABILITY_UNDECIDED && definite && x->told == x->m &&
        eigenvalue_range(x->G, x->m, x->m, &least, &most)) {
        if (least > SMALL * fmax(most, fast)) /* damping is positive definite */
            verdict = QDOT_STABLE;
        else if (least >= -1e-12 * fmax(most, fast))
            verdict = QDOT_STABLE_TO_FIRST_ORDER;
    }
    qdot_free(re);
    return verdict;
}

static qdot_stability
judge_stability(const qdot_judge *judge, const qdot_stability_numbers *numbers, motion *x,
                qdot_linear_roots *all)
{
    double h, g, least, most;
    bool symmetric, definite;

    if (x->m == 0)
        return QDOT_STABLE; /* no motion is possible */
    if (x->told == 0 || !normalise_mass(x))
        return QDOT_STABILITY_UNDECIDED;
    if (all != NULL && find_characteristic_roots(x, all->re, all->im))
        all->n = 2 * x->m;
    h = largest_modulus(x->m * x->m, x->H);
    g = largest_modulus(x->m * x->m, x->G);
    if (!eigenvalue_range(x->H, x->m, x->told, &least, &most))
        return QDOT_STABILITY_UNDECIDED;
    symmetric = largest_symmetric_entry(x->H, x->m, -1) <= SMALL * h;
    definite = symmetric && least > SMALL * h;
    if (definite && judge->law != QDOT_ENERGY_UNKNOWN)
        return QDOT_STABLE;
    if (judge->velocity_kink || judge->timed || !numbers->damped)
        return QDOT_STABILITY_UNDECIDED;
    if (symmetric && least < -SMALL * h && largest_symmetric_entry(x->G, x->m, -1) <= SMALL * fmax(g, sqrt(h)))
        return QDOT_UNSTABLE;
    return stability_by_roots(x, h, g, definite);
}

/* Judge stability at the present values of the symbols; also find the roots of the linear motion, if asked for. */
static qdot_status
judge_at_values(const qdot_judge *judge, qdot_stability_numbers *numbers, qdot_stability *verdict,
                qdot_linear_roots *all)
{
    size_t n = numbers->n;
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    gsl_matrix *N = gsl_matrix_calloc(n, n);
    motion x = {.M = qdot_calloc(3 * n * n + 1, sizeof *x.M)};
    bool finite = false;
    qdot_status status = N == NULL || x.M == NULL ? QDOT_ENOMEM : QDOT_OK;

    *verdict = QDOT_STABILITY_UNDECIDED;
    if (status == QDOT_OK)
        status = matrices_evaluate(numbers, &finite);
    if (status == QDOT_OK)
        raise_states(numbers);
    if (status == QDOT_OK && finite && find_tangent_space(numbers, N, &x)) {
        x.G = x.M + x.m * x.m;
        x.H = x.G + x.m * x.m;
        for (size_t k = 0; k < 3; k++)
            project_matrix(numbers->value + k * n * n, N, n, x.m, x.M + k * x.m * x.m);
        *verdict = judge_stability(judge, numbers, &x, all);
    }
    gsl_set_error_handler(before);
    gsl_matrix_free(N);
    qdot_free(x.M);
    return status;
}

qdot_status
qdot_stability_judge_numbers(const qdot_judge *judge, qdot_stability_numbers *numbers,
                             qdot_equilibrium *e)
{
    e->stability = QDOT_STABILITY_UNDECIDED;
    QDOT_TRY(set_equilibrium_values(numbers, e));
    return judge_at_values(judge, numbers, &e->stability, NULL);
}

qdot_status
qdot_stability_judge_at(const qdot_judge *judge, qdot_stability_numbers *numbers,
                        const qdot_stability_place *at, qdot_stability *verdict,
                        qdot_linear_roots *all)
{
    for (size_t i = 0; i < numbers->m; i++) {
        numbers->at[i] = 0;
        for (size_t k = 0; k < at->n; k++)
            if (at->symbols[k] == numbers->symbol[i])
                numbers->at[i] = at->values[k];
    }
    all->n = 0;
    return judge_at_values(judge, numbers, verdict, all);
}

const qdot_expr *
qdot_stability_slopes(const qdot_stability_numbers *numbers)
{
    return numbers->e;
}
