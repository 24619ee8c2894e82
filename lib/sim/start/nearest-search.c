/* nearest-search.c -- finds points with F = 0, and moves along that surface to the one nearest to a centre. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "num/cholesky.h"
#include "num/ldlt.h"
#include "sim/start/nearest.h"

enum { MOST_NEWTON = 100, MOST_SLIDES = 200, MOST_POLISH = 12 };

/* Distances below are relative to 1 + |x|. */
static const double on_it = 1e-8;   /* points with |F| below this count as on F = 0; the exact test uses balls */
static const double alike = 1e-6;   /* points nearer to each other than this are the same */
static const double as_near = 1e-9; /* distances that differ by less than this are equal */

/* A gradient smaller than this fraction of its row's largest one so far is rounding. */
static const double rounding = 1e-13;

typedef struct {
    qdot_nearest *p;
    size_t n;         /* number of free unknowns */
    size_t *index;    /* [n] index of each free unknown */
    const double *W;  /* weights of all unknowns; NULL: all 1 */
    double *C; /* [n x n] Cholesky factor C of the weights of the free unknowns, W = C C^T; NULL: 1 */
    qdot_row_space rows;
    double *B;        /* [m x n] rows C^-1 A_k, the gradients in the metric */
    double *size;     /* [m] lengths |A_k| of the gradients */
    double *widest;   /* [m] largest |A_k| so far, for nonlinear rows */
    double *b;        /* [m] right-hand sides */
    double *lambda;   /* [m] Lagrange multipliers */
    double *centre;   /* [inputs] the given point, from which distances are measured */
    double *step;     /* [n] Newton step */
    double *away;     /* [n] C^T (x - centre), the distance vector in the metric */
    double *from, *slid, *kept; /* [inputs] scratch: points that are saved */
    double *curvature; /* [curves] values of the second derivatives */
    double *curved_work;
} search;

static size_t
index_of_unknown(const search *s, size_t i)
{
    return s->p->first + s->index[i];
}

/* Set the size of row k: the length of its gradient, or the largest length so far if the present is rounding. */
static void
set_row_size(search *s, size_t k, double length)
{
    if (!s->p->linear[k] && isfinite(length)) {
        s->widest[k] = fmax(s->widest[k], length);
        length = length > rounding * s->widest[k] ? length : s->widest[k];
    }
    s->size[k] = length;
}

/* F and A at a point, |A_k|, and sum (F_k / |A_k|)^2 in units of `size`; infinite where
 * undefined. */
static double
search_evaluate(search *s, const double *at, bool measure)
{
    qdot_nearest *p = s->p;
    const double *A = p->value + p->m;
    double sum = 0;

    qdot_nearest_evaluate(p, at);
    for (size_t k = 0; k < p->m; k++) {
        double F = p->value[k];

        if (measure)
            set_row_size(s, k, qdot_nearest_length(A + k * p->n, p->n));
        if (!isfinite(s->size[k])) /* a gradient that is not finite: there is no zero nearby */
            sum = INFINITY;
        else if (F != 0)
            sum += (F / s->size[k]) * (F / s->size[k]);
    }
    return isnan(sum) ? INFINITY : sum;
}

/* Compute B = A C^-T, the gradients by the free unknowns in the metric W = C C^T. */
static void
transform_to_metric(search *s)
{
    const qdot_nearest *p = s->p;

    for (size_t k = 0; k < p->m; k++) {
        double *row = s->B + k * s->n, most = 0;

        for (size_t i = 0; i < s->n; i++)
            most = fmax(most, fabs(p->value[p->m + k * p->n + s->index[i]]));
        if (most <= rounding * s->widest[k]) {
            memset(row, 0, s->n * sizeof *row);
            continue;
        }
        for (size_t i = 0; i < s->n; i++) {
            row[i] = p->value[p->m + k * p->n + s->index[i]];
            for (size_t j = 0; s->C && j < i; j++)
                row[i] -= s->C[i * s->n + j] * row[j];
            if (s->C)
                row[i] /= s->C[i * s->n + i];
        }
    }
    qdot_row_space_factor(&s->rows, s->B, 1e-10, false);
}

/* Transform a vector x back from the metric W = C C^T: x becomes C^-T x. */
static void
transform_from_metric(const search *s, double *x)
{
    for (size_t i = s->n; s->C && i-- > 0;) {
        for (size_t j = i + 1; j < s->n; j++)
            x[i] -= s->C[j * s->n + i] * x[j];
        x[i] /= s->C[i * s->n + i];
    }
}

/* The distance of a point from the centre a in the metric W = C C^T; sets away = C^T (x - a). */
static double
distance_from_centre(search *s, const double *at)
{
    for (size_t i = 0; i < s->n; i++) {
        s->away[i] = 0;
        for (size_t j = s->C ? i : 0; s->C && j < s->n; j++)
            s->away[i] +=
                s->C[j * s->n + i] * (at[index_of_unknown(s, j)] - s->centre[index_of_unknown(s, j)]);
        if (!s->C)
            s->away[i] = at[index_of_unknown(s, i)] - s->centre[index_of_unknown(s, i)];
    }
    return qdot_nearest_length(s->away, s->n);
}

static void
move_free_unknowns(const search *s, const double *from, double scale, const double *step, double *to)
{
    for (size_t i = 0; i < s->n; i++)
        to[index_of_unknown(s, i)] = from[index_of_unknown(s, i)] + scale * step[i];
}

static double
relative_step_length(const search *s, const double *at, const double *step)
{
    double most = 0;

    for (size_t i = 0; i < s->n; i++)
        most = fmax(most, fabs(step[i]) / (1 + fabs(at[index_of_unknown(s, i)])));
    return most;
}

/* Whether every F_k is 0 within rounding; call after search_evaluate(at, true). */
static bool
is_on_constraints(const search *s, const double *at)
{
    double size = 0;

    for (size_t i = 0; i < s->p->n; i++)
        size = fmax(size, fabs(at[s->p->first + i]));
    for (size_t k = 0; k < s->p->m; k++)
        if (s->p->value[k] != 0
            && !(isfinite(s->size[k])
                 && fabs(s->p->value[k]) <= on_it * (1 + size) * s->size[k]))
            return false;
    return true;
}

/* Reach F = 0 by Newton steps of least length, each halved until it reduces the residual. */
static bool
restore_constraints(search *s, double *at)
{
    const qdot_nearest *p = s->p;

    for (int k = 0; k < MOST_NEWTON; k++) {
        double before = search_evaluate(s, at, true), scale = 1, after = INFINITY, left;

        if (!isfinite(before) || qdot_interrupt_is_set())
            return false;
        transform_to_metric(s);
        for (size_t i = 0; i < p->m; i++)
            s->b[i] = -p->value[i];
        qdot_row_space_shortest(&s->rows, s->b, s->step, NULL);
        transform_from_metric(s, s->step);
        left = relative_step_length(s, at, s->step);
        if (left < 1e-15)
            break;
        memcpy(s->from, at, p->inputs * sizeof *at);
        for (int half = 0; half < 12; half++, scale /= 2) {
            move_free_unknowns(s, s->from, scale, s->step, at);
            after = search_evaluate(s, at, false);
            if (after < before)
                break;
        }
        if (!(after < before)) {
            memcpy(at, s->from, p->inputs * sizeof *at);
            break;
        }
    }
    (void)search_evaluate(s, at, true);
    return is_on_constraints(s, at);
}

/* Move along F = 0 against the gradient of the distance; each step is projected back onto F = 0. */
static void
descend_on_constraints(search *s, double *at)
{
    const qdot_nearest *p = s->p;

    for (int k = 0; k < MOST_SLIDES; k++) {
        double near, slope, scale = 1;
        bool nearer = false;

        (void)search_evaluate(s, at, true);
        transform_to_metric(s);
        if (s->rows.rank >= s->n || qdot_interrupt_is_set())
            return;
        near = distance_from_centre(s, at);
        qdot_row_space_tangent(&s->rows, s->away);
        slope = qdot_nearest_length(s->away, s->n);
        if (!(slope > 1e-9 * (1 + near)))
            return;
        transform_from_metric(s, s->away);
        memcpy(s->slid, s->away, s->n * sizeof *s->slid);
        memcpy(s->kept, at, p->inputs * sizeof *at);
        for (; scale > 1e-5 && !nearer; scale /= 2) {
            double now;

            move_free_unknowns(s, s->kept, -scale, s->slid, at);
            if (!restore_constraints(s, at))
                continue;
            now = distance_from_centre(s, at);
            nearer = now * now < near * near - 0.1 * scale * slope * slope;
        }
        if (!nearer) {
            memcpy(at, s->kept, p->inputs * sizeof *at);
            return;
        }
    }
}

/* --- using second derivatives ------------------------------------------------------- */

static qdot_status
make_second_derivatives(qdot_nearest *p)
{
    qdot_vec(qdot_expr) out = {0};
    qdot_vec(uint32_t) where = {0};
    qdot_status status = QDOT_OK;

    for (size_t e = 0; e < p->m * p->n && status == QDOT_OK; e++) {
        qdot_expr atoms = qdot_expr_atoms(p->pool, p->A[e], false);
        size_t i = e % p->n;

        for (size_t j = 0; j <= i && status == QDOT_OK; j++) {
            qdot_expr x = p->symbol[p->first + j], c;

            if (!qdot_list_has(p->pool, atoms, x))
                continue;
            p->bent = true;
            c = qdot_diff(p->pool, p->A[e], x);
            if (c == QDOT_ZERO)
                continue;
            status = qdot_vec_push(&out, c);
            if (status == QDOT_OK)
                status = qdot_vec_push(&where, (uint32_t)(e / p->n));
            if (status == QDOT_OK)
                status = qdot_vec_push(&where, (uint32_t)i);
            if (status == QDOT_OK)
                status = qdot_vec_push(&where, (uint32_t)j);
        }
        if (status == QDOT_OK)
            status = qdot_pool_check(p->pool);
    }
    if (status == QDOT_OK && out.n > 0)
        status = qdot_tape_new(p->pool, p->inputs, p->symbol, out.n, out.at, &p->curved);
    p->place = where.at;
    p->curves = out.n;
    p->curves_known = status == QDOT_OK;
    qdot_free(out.at);
    return status;
}

/* K = [W + sum lambda_k d2F_k, A^T; A, 0] over the independent rows, and r = -(W (x - a)
 * + A^T lambda, F); lower triangle. */
static void
assemble_newton_system(search *s, const double *at, double *K, double *r)
{
    const qdot_nearest *p = s->p;
    size_t n = s->n, rank = s->rows.rank, size = n + rank;
    const double *A = p->value + p->m;

    memset(K, 0, size * size * sizeof *K);
    memset(r, 0, size * sizeof *r);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            double w = s->W   ? s->W[s->index[i] * p->n + s->index[j]]
                       : i == j ? 1
                                : 0;

            K[i * size + j] += w;
            r[i] -= w * (at[index_of_unknown(s, j)] - s->centre[index_of_unknown(s, j)]);
        }
    for (size_t c = 0; c < p->curves; c++) {
        double h = s->lambda[p->place[3 * c]] * s->curvature[c];
        size_t i = n, j = n;

        for (size_t k = 0; k < n; k++) {
            if (s->index[k] == p->place[3 * c + 1])
                i = k;
            if (s->index[k] == p->place[3 * c + 2])
                j = k;
        }
        if (i < n && j < n)
            K[(i > j ? i : j) * size + (i > j ? j : i)] += h;
    }
    for (size_t k = 0; k < rank; k++) {
        size_t row = s->rows.order[k];

        r[n + k] = -p->value[row];
        for (size_t i = 0; i < n; i++) {
            double slope = A[row * p->n + s->index[i]];

            K[(n + k) * size + i] = slope;
            r[i] -= slope * s->lambda[row];
        }
    }
}

/* Find, by Newton's method, a point of F = 0 with stationary distance from the centre, while steps shrink. */
static qdot_status
find_stationary_distance(search *s, double *at)
{
    qdot_nearest *p = s->p;
    double last = 1e-2, *K, *r;
    qdot_status status = QDOT_OK;

    (void)search_evaluate(s, at, true);
    transform_to_metric(s);
    if (s->rows.rank >= s->n)
        return QDOT_OK;
    (void)distance_from_centre(s, at);
    for (size_t k = 0; k < p->m; k++) {
        s->b[k] = 0;
        for (size_t i = 0; i < s->n; i++)
            s->b[k] -= s->B[k * s->n + i] * s->away[i];
    }
    qdot_row_space_shortest(&s->rows, s->b, s->step, s->lambda);
    K = qdot_calloc((s->n + p->m) * (s->n + p->m + 1), sizeof *K);
    if (!K)
        return QDOT_ENOMEM;
    r = K + (s->n + p->m) * (s->n + p->m);
    memcpy(s->kept, at, p->inputs * sizeof *at);
    for (int k = 0; k < MOST_POLISH && status == QDOT_OK; k++) {
        size_t size = s->n + s->rows.rank;
        qdot_ldlt f;
        double step;

        status = qdot_interrupt_check();
        if (status != QDOT_OK)
            break;
        if (p->curved)
            qdot_tape_eval(p->curved, at, s->curvature, s->curved_work);
        assemble_newton_system(s, at, K, r);
        status = qdot_ldlt_init(&f, size);
        if (status != QDOT_OK)
            break;
        if (qdot_ldlt_factor(&f, K, NULL) != QDOT_OK) {
            qdot_ldlt_clear(&f);
            break;
        }
        qdot_ldlt_solve(&f, K, r);
        qdot_ldlt_clear(&f);
        step = relative_step_length(s, at, r);
        if (!(step < last))
            break;
        last = step;
        move_free_unknowns(s, at, 1, r, at);
        for (size_t i = 0; i < s->rows.rank; i++)
            s->lambda[s->rows.order[i]] += r[s->n + i];
        if (!isfinite(search_evaluate(s, at, true)) || step < 1e-16)
            break;
    }
    if (last > 1e-6 && last < 1e-2) /* Newton's method has converged to another point */
        memcpy(at, s->kept, p->inputs * sizeof *at);
    qdot_free(K);
    return status;
}

/* --- searching from several points -------------------------------------------------- */

static double
random_sign(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*seed >> 11) * 0x1p-53) * 2 - 1;
}

/* Choose the k-th start of the search: the centre, then pairs of points at different distances from it. */
static void
choose_starting_point(const search *s, int k, double *at)
{
    static const double reach[] = {1, 0.3, 3};
    double size = 0;
    uint64_t seed = (uint64_t)((k + 1) / 2) + 1;

    memcpy(at, s->centre, s->p->inputs * sizeof *at);
    if (k == 0)
        return;
    for (size_t i = 0; i < s->p->n; i++)
        size = fmax(size, fabs(at[s->p->first + i]));
    size = (size > 0 ? size : 1) * reach[(k + 1) / 2 % 3] * (k % 2 ? 1 : -1);
    (void)random_sign(&seed);
    for (size_t i = 0; i < s->n; i++)
        at[index_of_unknown(s, i)] += size * random_sign(&seed);
}

static bool
is_different_point(const search *s, const double *x, const double *y)
{
    for (size_t i = 0; i < s->n; i++)
        if (fabs(x[index_of_unknown(s, i)] - y[i]) > alike * (1 + fabs(y[i])))
            return true;
    return false;
}

static qdot_status
search_from_many_points(search *s, double *at, double *best, double *other, qdot_nearest_outcome *outcome)
{
    const qdot_nearest *p = s->p;
    int points = !p->bent ? 1 : s->n <= 8 ? 33 : s->n <= 32 ? 17 : 9;
    double nearest = INFINITY;

    *outcome = QDOT_NEAREST_NONE;
    for (int k = 0; k < points; k++) {
        double far;

        QDOT_TRY(qdot_interrupt_check());
        choose_starting_point(s, k, at);
        if (!restore_constraints(s, at))
            continue;
        descend_on_constraints(s, at);
        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(find_stationary_distance(s, at));
        (void)search_evaluate(s, at, true);
        if (!is_on_constraints(s, at) || (p->domains && qdot_domains_outside(p->domains, at)))
            continue;
        far = distance_from_centre(s, at);
        if (far > nearest + as_near * (1 + nearest))
            continue;
        if (far < nearest - as_near * (1 + nearest) || !isfinite(nearest)) {
            nearest = far;
            *outcome = QDOT_NEAREST_FOUND;
            for (size_t i = 0; i < s->n; i++)
                best[i] = at[index_of_unknown(s, i)];
        } else if (is_different_point(s, at, best)) {
            *outcome = QDOT_NEAREST_SEVERAL;
            memcpy(other, at + p->first, p->n * sizeof *other);
        }
    }
    memcpy(at, s->centre, p->inputs * sizeof *at);
    for (size_t i = 0; i < s->n && *outcome != QDOT_NEAREST_NONE; i++)
        at[index_of_unknown(s, i)] = best[i];
    return QDOT_OK;
}

/* Factor the weights W of the free unknowns as C C^T; C stays unset if W is not positive definite. */
static qdot_status
factor_weights(search *s)
{
    size_t n = s->n;

    s->C = qdot_calloc(n * n + 1, sizeof *s->C);
    if (!s->C)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            s->C[i * n + j] = s->W[s->index[i] * s->p->n + s->index[j]];
    if (qdot_cholesky_factor(s->C, n, NULL, NULL) == QDOT_OK)
        return QDOT_OK;
    qdot_free(s->C);
    s->C = NULL;
    s->W = NULL;
    return QDOT_OK;
}

static void
search_clear(search *s)
{
    qdot_row_space_clear(&s->rows);
    qdot_free(s->index);
    qdot_free(s->C);
    qdot_free(s->B);
    qdot_free(s->size);
    qdot_free(s->centre);
    qdot_free(s->curvature);
    qdot_free(s->curved_work);
}

static qdot_status
search_init(search *s, const bool *free, const double *at)
{
    const qdot_nearest *p = s->p;
    size_t m = p->m, n;

    s->index = qdot_calloc(p->n + 1, sizeof *s->index);
    if (!s->index)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->n; i++)
        if (free[i])
            s->index[s->n++] = i;
    n = s->n;
    QDOT_TRY(qdot_row_space_init(&s->rows, m, n));
    s->B = qdot_calloc(m * n + 1, sizeof *s->B);
    s->size = qdot_calloc(4 * m + 2 * n + 1, sizeof *s->size);
    s->centre = qdot_calloc(4 * p->inputs + 1, sizeof *s->centre);
    s->curvature = qdot_calloc(p->curves + 1, sizeof *s->curvature);
    s->curved_work = qdot_calloc(p->curved ? qdot_tape_work(p->curved) + 1 : 1,
                                 sizeof *s->curved_work);
    if (!s->B || !s->size || !s->centre || !s->curvature || !s->curved_work)
        return QDOT_ENOMEM;
    s->widest = s->size + m;
    s->b = s->widest + m;
    s->lambda = s->b + m;
    s->step = s->lambda + m;
    s->away = s->step + n;
    s->from = s->centre + p->inputs;
    s->slid = s->from + p->inputs;
    s->kept = s->slid + p->inputs;
    memcpy(s->centre, at, p->inputs * sizeof *at);
    return s->W ? factor_weights(s) : QDOT_OK;
}

qdot_status
qdot_nearest_find(qdot_nearest *p, const bool *free, const double *W, double *at,
                  double *other, qdot_nearest_outcome *outcome)
{
    search s = {.p = p, .W = W};
    double *best;
    qdot_status status = p->curves_known ? QDOT_OK : make_second_derivatives(p);

    *outcome = QDOT_NEAREST_NONE;
    if (status == QDOT_OK)
        status = search_init(&s, free, at);
    best = status == QDOT_OK ? qdot_calloc(s.n + 1, sizeof *best) : NULL;
    if (status == QDOT_OK && !best)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK && s.n > 0)
        status = search_from_many_points(&s, at, best, other, outcome);
    qdot_free(best);
    search_clear(&s);
    return status;
}
