/* rest-path.c -- tangents, corrections, and what is judged at a point of a curve. */
#include "sim/study/rest-path.h"

#include <math.h>
#include <string.h>

#include "tape/derivative.h"

/* Roots with real parts beyond GROWS of the fastest count as growing. */
static const double grows = 1e-7;
static const double weight_of_multipliers = 1e-3;
enum { STEPS = 10 };

qdot_status
qdot_rest_path_begin(qdot_rest_path *x, qdot_equilibrium_curve *c, double least, double most)
{
    const size_t n = c->n, m = n + 1;

    *x = (qdot_rest_path){.c = c, .n = n, .least = least, .most = most};
    QDOT_TRY(qdot_tape_new(c->pool, m, c->unknown, n, c->F, &x->tape));
    x->weight = qdot_calloc(m + n + n * m + m * m + m, sizeof *x->weight);
    x->rows = qdot_calloc(m, sizeof *x->rows);
    x->work = qdot_malloc(qdot_derivative_work(x->tape) * sizeof *x->work);
    if (!x->weight || !x->rows || !x->work)
        return QDOT_ENOMEM;
    x->F = x->weight + m;
    x->J = x->F + n;
    x->A = x->J + n * m;
    x->b = x->A + m * m;
    return QDOT_OK;
}

void
qdot_rest_path_scale(qdot_rest_path *x, const double *size)
{
    for (size_t i = 0; i <= x->n; i++) {
        double w = 1 / (i < x->n ? size[i] : x->most - x->least);

        if (i >= x->c->coordinates && i < x->n)
            w *= weight_of_multipliers;
        x->weight[i] = w * w;
    }
}

void
qdot_rest_path_end(qdot_rest_path *x)
{
    qdot_tape_free(x->tape);
    qdot_free(x->weight);
    qdot_free(x->rows);
    qdot_free(x->work);
    *x = (qdot_rest_path){0};
}

qdot_status
qdot_rest_point_begin(const qdot_rest_path *x, qdot_rest_point *a)
{
    *a = (qdot_rest_point){.y = qdot_calloc(2 * (x->n + 1), sizeof *a->y)};
    if (a->y == NULL)
        return QDOT_ENOMEM;
    a->t = a->y + x->n + 1;
    return QDOT_OK;
}

void
qdot_rest_point_end(qdot_rest_point *a)
{
    qdot_free(a->y);
    *a = (qdot_rest_point){0};
}

void
qdot_rest_point_copy(const qdot_rest_path *x, const qdot_rest_point *from, qdot_rest_point *to)
{
    memcpy(to->y, from->y, 2 * (x->n + 1) * sizeof *to->y);
    to->sign = from->sign;
    to->growing = from->growing;
    to->stability = from->stability;
}

double
qdot_rest_path_product(const qdot_rest_path *x, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i <= x->n; i++)
        sum += x->weight[i] * a[i] * b[i];
    return sum;
}

double
qdot_rest_path_distance(const qdot_rest_path *x, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i <= x->n; i++) {
        double d = a[i] - b[i];

        if (i < x->n && x->c->angle[i])
            d -= 2 * M_PI * round(d / (2 * M_PI));
        sum += x->weight[i] * d * d;
    }
    return sqrt(sum);
}

void
qdot_rest_path_evaluate(qdot_rest_path *x, const double *y)
{
    qdot_derivative_eval(x->tape, y, 0, x->n + 1, x->F, x->J, x->work);
}

/* Factor [J; g^T], J as it was evaluated. */
static bool
factor(qdot_rest_path *x, const double *g)
{
    const size_t n = x->n, m = n + 1;

    memcpy(x->A, x->J, n * m * sizeof *x->A);
    memcpy(x->A + n * m, g, m * sizeof *x->A);
    return qdot_lu_factor(m, x->A, x->rows);
}

bool
qdot_rest_path_solve(qdot_rest_path *x, const double *g, double *y, int *steps)
{
    const size_t n = x->n;
    double before = INFINITY;

    for (*steps = 1; *steps <= STEPS; ++*steps) {
        double length;

        qdot_rest_path_evaluate(x, y);
        for (size_t i = 0; i < n; i++) {
            if (!isfinite(x->F[i]))
                return false;
            x->b[i] = -x->F[i];
        }
        x->b[n] = 0;
        if (!factor(x, g))
            return false;
        qdot_lu_solve(n + 1, x->A, x->rows, x->b);
        length = sqrt(qdot_rest_path_product(x, x->b, x->b));
        if (!isfinite(length) || length > 2 * before)
            return false;
        for (size_t i = 0; i <= n; i++)
            y[i] += x->b[i];
        if (length < 1e-15 || (length < 1e-10 && length > before / 4))
            return true;
        before = length;
    }
    return before < 1e-10;
}

bool
qdot_rest_path_hold(qdot_rest_path *x, size_t i, double *y)
{
    double *const g = qdot_calloc(x->n + 1, sizeof *g);
    const double held = y[i];
    int steps;
    bool good = false;

    if (g == NULL)
        return false;
    g[i] = 1;
    good = qdot_rest_path_solve(x, g, y, &steps);
    y[i] = held;
    qdot_free(g);
    return good;
}

/* The sign of the determinant of what was factored. */
static int
sign_of(const qdot_rest_path *x)
{
    const size_t m = x->n + 1;
    int sign = 1;

    for (size_t k = 0; k < m; k++) {
        sign = x->A[k * m + k] < 0 ? -sign : sign;
        sign = x->rows[k].pivot != k ? -sign : sign;
    }
    return sign;
}

bool
qdot_rest_path_tangent(qdot_rest_path *x, const double *along, qdot_rest_point *a)
{
    const size_t n = x->n;
    double length;

    qdot_rest_path_evaluate(x, a->y);
    for (size_t i = 0; i <= n; i++)
        x->b[i] = x->weight[i] * along[i];
    if (!factor(x, x->b))
        return false;
    a->sign = sign_of(x);
    for (size_t i = 0; i <= n; i++)
        x->b[i] = i == n;
    qdot_lu_solve(n + 1, x->A, x->rows, x->b);
    length = sqrt(qdot_rest_path_product(x, x->b, x->b));
    if (!isfinite(length) || length == 0)
        return false;
    for (size_t i = 0; i <= n; i++)
        a->t[i] = x->b[i] / length;
    return true;
}

bool
qdot_rest_path_go(qdot_rest_path *x, const qdot_rest_point *a, double s, qdot_rest_point *to,
                  int *steps)
{
    const size_t n = x->n;

    for (size_t i = 0; i <= n; i++) {
        to->y[i] = a->y[i] + s * a->t[i];
        to->t[i] = x->weight[i] * a->t[i];
    }
    return qdot_rest_path_solve(x, to->t, to->y, steps) && qdot_rest_path_tangent(x, a->t, to);
}

qdot_status
qdot_rest_path_judge(qdot_rest_path *x, qdot_rest_point *a)
{
    const qdot_linear_roots *r = &x->c->roots;
    double fast = 0;

    QDOT_TRY(qdot_equilibrium_curve_judge(x->c, a->y, &a->stability));
    for (size_t i = 0; i < r->n; i++)
        fast = fmax(fast, hypot(r->re[i], r->im[i]));
    a->growing = r->n == 0 ? -1 : 0;
    for (size_t i = 0; i < r->n; i++)
        a->growing += r->re[i] > grows * fast;
    return QDOT_OK;
}
