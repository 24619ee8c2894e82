/* equilibrium-numeric.c -- places of rest in numbers: by exclusion (equilibrium-proved.c), and where that does
 * not prove them all, by Levenberg's and Marquardt's steps from many starts, each place proved
 * (normal/solve/isolate.h).
 *
 * Starts lie within the declared domains, a full turn of an angle, and else within +-RANGE of several sizes.
 * Multipliers begin with the values that leave least of the equations there; so what is
 * searched through is the coordinates alone. A force that only fades, far away, leaves Newton's
 * steps as long as the distance: no place to prove. */
#include <math.h>

#include <gsl/gsl_linalg.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/generic.h"
#include "mech/study/equilibrium-search.h"
#include "normal/solve/isolate.h"

enum { STARTS = 240, STEPS = 60, MOST = QDOT_PLACES_MOST, NEWTON = 6 };

/* Half widths of the boxes from which start points of Newton's method are drawn, used cyclically. */
static const double ranges[] = {1.5, 4, 1.5, 12, 1.5, 4, 40, 100};
enum { RANGES = sizeof ranges / sizeof *ranges };

typedef struct {
    qdot_pool *pool;
    size_t n, slopes;
    size_t coordinates; /* how many unknowns are coordinates, which come first; the others are multipliers */
    const qdot_expr *u;
    qdot_expr *e;            /* [n + slopes] the residuals, then their non-zero derivatives */
    size_t *row, *column;    /* [slopes] row and column of each derivative */
    double *lo, *hi;         /* [n] bounds of the domains */
    bool *angle;             /* [n] whether the unknown is an angle without bounds, with period 2 pi */
    double *value;           /* [n + slopes] values of e at x */
    double *x, *try, *step;  /* [n] point, trial point, Newton step */
    double *rhs;             /* [n] right side of the Newton equations */
    gsl_matrix *J, *A;       /* Jacobian [n x n]; J^T J + damping [n x n] */
    gsl_permutation *order;
} problem;

/* --- equations, domains and work space ------------------------------------------------ */

static double
domain_end(const qdot_pool *pool, qdot_expr e, double otherwise)
{
    double v;

    if (e == QDOT_NIL ||
        qdot_generic_evaluate(pool, 1, &e, NULL, &v) != QDOT_OK ||
        qdot_expr_node(pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN)
        return otherwise;
    return v;
}

static qdot_status
problem_begin(problem *p, const qdot_rest *rest, const qdot_expr *r)
{
    size_t n = p->n;
    qdot_expr equations;

    p->e = qdot_calloc(n + n * n + 1, sizeof *p->e);
    p->row = qdot_calloc(2 * n * n + 1, sizeof *p->row);
    p->value = qdot_calloc(n + n * n + 6 * n + 1, sizeof *p->value);
    p->angle = qdot_calloc(n + 1, sizeof *p->angle);
    p->J = gsl_matrix_alloc(n, n);
    p->A = gsl_matrix_alloc(n, n);
    p->order = gsl_permutation_alloc(n);
    if (p->e == NULL || p->row == NULL || p->value == NULL || p->angle == NULL ||
        p->J == NULL || p->A == NULL || p->order == NULL)
        return QDOT_ENOMEM;
    p->column = p->row + n * n;
    p->x = p->value + n + n * n;
    p->try = p->x + n;
    p->step = p->try + n;
    p->rhs = p->step + n;
    p->lo = p->rhs + n;
    p->hi = p->lo + n;
    for (size_t i = 0; i < n; i++) {
        p->e[i] = r[i];
        for (size_t j = 0; j < n; j++) {
            qdot_expr slope = qdot_diff(p->pool, r[i], p->u[j]);

            if (slope == QDOT_ZERO)
                continue;
            p->e[n + p->slopes] = slope;
            p->row[p->slopes] = i;
            p->column[p->slopes++] = j;
        }
    }
    QDOT_TRY(qdot_pool_check(p->pool));
    equations = qdot_list(p->pool, (uint32_t)n, r);
    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t i = 0; i < n; i++) {
        qdot_window w = qdot_rest_window(rest, i, equations);

        p->angle[i] = w.turn;
        p->lo[i] = w.turn ? -INFINITY : domain_end(p->pool, w.lo, -INFINITY);
        p->hi[i] = w.turn ? INFINITY : domain_end(p->pool, w.hi, INFINITY);
    }
    return qdot_pool_check(p->pool);
}

static void
problem_end(problem *p)
{
    qdot_free(p->e);
    qdot_free(p->row);
    qdot_free(p->value);
    qdot_free(p->angle);
    gsl_matrix_free(p->J);
    gsl_matrix_free(p->A);
    gsl_permutation_free(p->order);
}

/* Evaluate the residuals at x, and the derivatives if wanted; *most is the largest, INFINITY if one
 * is undefined. */
static qdot_status
evaluate_residuals(problem *p, const double *x, bool slopes, double *most)
{
    size_t m = p->n + (slopes ? p->slopes : 0);

    QDOT_TRY(qdot_generic_evaluate(p->pool, m, p->e,
                                   &(qdot_generic_point){p->n, p->u, x, 1}, p->value));
    *most = 0;
    for (size_t i = 0; i < m; i++)
        *most = !isfinite(p->value[i]) ? INFINITY
                : i < p->n             ? fmax(*most, fabs(p->value[i]))
                                       : *most;
    if (!slopes || isinf(*most))
        return QDOT_OK;
    gsl_matrix_set_zero(p->J);
    for (size_t k = 0; k < p->slopes; k++)
        gsl_matrix_set(p->J, p->row[k], p->column[k], p->value[p->n + k]);
    return QDOT_OK;
}

static double
residual_square(const problem *p)
{
    double sum = 0;

    for (size_t i = 0; i < p->n; i++)
        sum += p->value[i] * p->value[i];
    return sum;
}

/* --- steps of the search ------------------------------------------------------------------ */

/* Compute step = -(J^T J + by)^-1 J^T r for the unknowns from `first` on; false on failure. */
static bool
damped_step(problem *p, size_t first, double by)
{
    size_t m = p->n - first;
    gsl_matrix_view J = gsl_matrix_submatrix(p->J, 0, first, p->n, m),
                    A = gsl_matrix_submatrix(p->A, 0, 0, m, m);
    gsl_vector_view step = gsl_vector_view_array(p->step + first, m);

    for (size_t i = 0; i < m; i++) {
        double sum = 0;

        for (size_t k = 0; k < p->n; k++)
            sum -= gsl_matrix_get(&J.matrix, k, i) * p->value[k];
        p->step[first + i] = sum;
        for (size_t j = 0; j <= i; j++) {
            sum = 0;
            for (size_t k = 0; k < p->n; k++)
                sum += gsl_matrix_get(&J.matrix, k, i) * gsl_matrix_get(&J.matrix, k, j);
            gsl_matrix_set(&A.matrix, i, j, sum);
            gsl_matrix_set(&A.matrix, j, i, sum);
        }
    }
    for (size_t i = 0; i < m; i++)
        gsl_matrix_set(&A.matrix, i, i, gsl_matrix_get(&A.matrix, i, i) * (1 + by) + by * 1e-3);
    return gsl_linalg_cholesky_decomp1(&A.matrix) == GSL_SUCCESS &&
           gsl_linalg_cholesky_svx(&A.matrix, &step.vector) == GSL_SUCCESS;
}

/* Compute Newton's step by LU decomposition; false where the Jacobian J is singular. */
static bool
equilibrium_newton_step(problem *p)
{
    gsl_vector_view step = gsl_vector_view_array(p->step, p->n);
    int sign;

    for (size_t i = 0; i < p->n; i++)
        p->step[i] = -p->value[i];
    if (gsl_linalg_LU_decomp(p->J, p->order, &sign) != GSL_SUCCESS ||
        gsl_linalg_LU_svx(p->J, p->order, &step.vector) != GSL_SUCCESS)
        return false;
    for (size_t i = 0; i < p->n; i++)
        if (!isfinite(p->step[i]))
            return false;
    return true;
}

static void
set_start_point(problem *p, uint64_t start)
{
    for (size_t i = 0; i < p->n; i++) {
        /* use two seeds, so that the start is independent of the seed derived from the name */
        double v = qdot_generic_value(p->pool, p->u[i], start),
               range = p->angle[i] ? M_PI : ranges[start % RANGES];

        if (isinf(p->lo[i]) && isinf(p->hi[i]))
            v *= range / 1.5;
        else if (isinf(p->hi[i]))
            v = p->lo[i] + (v - p->lo[i]) * range / 1.5;
        else if (isinf(p->lo[i]))
            v = p->hi[i] - (p->hi[i] - v) * range / 1.5;
        p->x[i] = i < p->coordinates ? v : 0;
    }
}

typedef enum { NOWHERE, CANDIDATE, FLAT } end; /* how a descent ends; FLAT: the residuals are 0, but J is singular */

/* Whether the residual is rounding error, compared to its derivatives times x. */
static bool
residual_is_rounding_error(const problem *p, double most)
{
    double scale = 0;

    for (size_t k = 0; k < p->slopes; k++)
        scale = fmax(scale, fabs(p->value[p->n + k]) * fmax(fabs(p->x[p->column[k]]), 1e-3));
    return most <= 1e-12 * scale;
}

static qdot_status
descend_to_equilibrium(problem *p, end *how)
{
    double most, before, by = 1e-2, length = INFINITY;
    bool holds;

    *how = NOWHERE;
    QDOT_TRY(evaluate_residuals(p, p->x, true, &most));
    if (isfinite(most) && p->n > p->coordinates && damped_step(p, p->coordinates, 1e-12)) {
        for (size_t i = p->coordinates; i < p->n; i++)
            p->x[i] += p->step[i];
        QDOT_TRY(evaluate_residuals(p, p->x, true, &most));
    }
    for (int k = 0; k < STEPS && isfinite(most) && most > 0; k++) {
        before = residual_square(p);
        if (!damped_step(p, 0, by)) {
            by = fmax(10 * by, 1e-8);
            continue;
        }
        length = 0;
        for (size_t i = 0; i < p->n; i++) {
            p->try[i] = p->x[i] + p->step[i];
            length = fmax(length, fabs(p->step[i]) / fmax(fabs(p->x[i]), 1e-3));
        }
        QDOT_TRY(evaluate_residuals(p, p->try, true, &most));
        if (isfinite(most) && residual_square(p) < before) {
            for (size_t i = 0; i < p->n; i++)
                p->x[i] = p->try[i];
            by = fmax(by * 0.1, 1e-14);
            if (length < 1e-9)
                break;
        } else {
            by *= 10;
            QDOT_TRY(evaluate_residuals(p, p->x, true, &most));
            if (by > 1e12)
                break;
        }
    }
    if (!isfinite(most))
        return QDOT_OK;
    holds = residual_is_rounding_error(p, most);
    length = INFINITY;
    for (int k = 0; k < NEWTON; k++) {
        if (!equilibrium_newton_step(p))
            break;
        length = 0;
        for (size_t i = 0; i < p->n; i++)
            length = fmax(length, fabs(p->step[i]) / fmax(fabs(p->x[i]), 1e-3));
        if (length > 0.1)
            break;
        for (size_t i = 0; i < p->n; i++)
            p->x[i] += p->step[i];
        QDOT_TRY(evaluate_residuals(p, p->x, true, &most));
        if (!isfinite(most))
            return QDOT_OK;
        if (length < 1e-12)
            break;
    }
    *how = length < 1e-7 ? CANDIDATE : holds ? FLAT : NOWHERE;
    return QDOT_OK;
}

/* --- what was found --------------------------------------------------------------------- */

/* Reduce angles to -pi < q <= pi; returns whether x lies within the domains. */
static bool
normalise_angles(const problem *p, double *x)
{
    for (size_t i = 0; i < p->n; i++) {
        if (p->angle[i])
            x[i] -= 2 * M_PI * ceil((x[i] - M_PI) / (2 * M_PI) - 1e-9);
        if (x[i] <= p->lo[i] || x[i] >= p->hi[i])
            return false;
    }
    return true;
}

static bool
is_new_equilibrium(const double *found, size_t count, size_t n, const double *x)
{
    for (size_t k = 0; k < count; k++) {
        double apart = 0;

        for (size_t i = 0; i < n; i++)
            apart = fmax(apart, fabs(found[k * n + i] - x[i]) / fmax(1, fabs(x[i])));
        if (apart < 1e-7)
            return false;
    }
    return true;
}

void
qdot_places_sort(qdot_places *places, size_t n)
{
    for (size_t a = 1; a < places->n; a++)
        for (size_t b = a; b > 0; b--) {
            double *x = places->at + (b - 1) * n, *y = places->at + b * n;
            size_t i = 0;

            while (i < n && fabs(x[i] - y[i]) < 1e-9)
                i++;
            if (i == n || x[i] < y[i])
                break;
            for (i = 0; i < n; i++) {
                double keep = x[i];

                x[i] = y[i];
                y[i] = keep;
            }
        }
}

static qdot_status
search_equilibria(problem *p, qdot_isolate *isolate, qdot_places *out)
{
    size_t n = p->n;

    for (uint64_t start = 1; start <= STARTS && out->n < MOST; start++) {
        double *place = out->at + out->n * n, *radius = p->rhs;
        end how;

        QDOT_TRY(qdot_interrupt_check());
        set_start_point(p, start);
        QDOT_TRY(descend_to_equilibrium(p, &how));
        out->starts++;
        if (how == NOWHERE || !normalise_angles(p, p->x) || !is_new_equilibrium(out->at, out->n, n, p->x))
            continue;
        for (size_t i = 0; i < n; i++)
            place[i] = p->x[i];
        if (how == FLAT || !qdot_isolate_prove(isolate, place, radius) ||
            !qdot_rest_is_sharp(n, place, radius)) {
            out->unproved++;
            continue;
        }
        for (size_t i = 0; i < n; i++)
            if (fabs(place[i]) <= radius[i]) /* the value is 0 within its error bound */
                place[i] = 0;
        if (normalise_angles(p, place) && is_new_equilibrium(out->at, out->n, n, place))
            out->n++;
    }
    qdot_places_sort(out, n);
    return QDOT_OK;
}

void
qdot_places_clear(qdot_places *places)
{
    qdot_free(places->at);
    *places = (qdot_places){0};
}

static qdot_status
search_from_starts(qdot_rest *rest, const qdot_expr *r, qdot_places *out)
{
    problem p = {.pool = rest->pool,
                 .n = rest->searched,
                 .coordinates = rest->system.places,
                 .u = rest->system.unknowns.at};
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    qdot_isolate isolate;
    qdot_status status = problem_begin(&p, rest, r);

    out->reach = ranges[RANGES - 1];
    if (status == QDOT_OK)
        status = qdot_isolate_begin(&isolate, p.pool, p.n, r, p.u);
    if (status == QDOT_OK) {
        status = search_equilibria(&p, &isolate, out);
        qdot_isolate_end(&isolate);
    }
    problem_end(&p);
    gsl_set_error_handler(before);
    return status;
}

qdot_status
qdot_rest_search(qdot_rest *rest, const qdot_expr *r, qdot_places *out)
{
    qdot_status status;
    qdot_expr equations = qdot_list(rest->pool, (uint32_t)rest->searched, r);

    *out = (qdot_places){0};
    QDOT_TRY(qdot_pool_check(rest->pool));
    for (size_t k = 0; k < rest->system.places; k++)
        rest->system.recurs = rest->system.recurs || qdot_rest_window(rest, k, equations).recurs;
    QDOT_TRY(qdot_pool_check(rest->pool));
    out->at = qdot_calloc((MOST + 1) * rest->system.unknowns.n + 1, sizeof *out->at);
    status = out->at == NULL ? QDOT_ENOMEM : qdot_rest_search_branches(rest, out);
    if (status == QDOT_OK && !out->complete)
        status = qdot_rest_exclude(rest, r, out);
    if (status == QDOT_OK && out->complete)
        rest->system.complete = true;
    else if (status == QDOT_OK)
        status = search_from_starts(rest, r, out);
    if (status != QDOT_OK)
        qdot_places_clear(out);
    return status;
}
