/* path.c -- follows curves of zeros of F(y) = 0: tangents, predictions and corrections. */
#include "sim/branches/path.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

static const double weight_of_rest = 1e-3;
enum { STEPS = 10 };

qdot_status
qdot_path_begin(qdot_path *x, size_t n)
{
    const size_t m = n + 1;

    *x = (qdot_path){.n = n,
                     .coordinates = n,
                     .width = m,
                     .exact = 1e-15,
                     .gauge = 1,
                     .shortest = 1e-10,
                     .longest = 1e-2,
                     .upright = 1e-9,
                     .least_jump = 1,
                     .halvings = 40};
    x->weight = qdot_calloc(m + n + n * m + m * m + m, sizeof *x->weight);
    x->rows = qdot_calloc(m, sizeof *x->rows);
    if (!x->weight || !x->rows)
        return QDOT_ENOMEM;
    x->F = x->weight + m;
    x->J = x->F + n;
    x->A = x->J + n * m;
    x->b = x->A + m * m;
    return QDOT_OK;
}

void
qdot_path_end(qdot_path *x)
{
    qdot_free(x->weight);
    qdot_free(x->rows);
    *x = (qdot_path){0};
}

void
qdot_path_scale(qdot_path *x, const double *size)
{
    for (size_t i = 0; i <= x->n; i++) {
        double w = 1 / (i < x->n ? size[i] : x->most - x->least);

        if (i >= x->coordinates && i < x->n)
            w *= weight_of_rest;
        x->weight[i] = w * w;
    }
}

qdot_status
qdot_path_point_begin(const qdot_path *x, qdot_path_point *a)
{
    *a = (qdot_path_point){.y = qdot_calloc(x->width + x->n + 1, sizeof *a->y)};
    if (a->y == NULL)
        return QDOT_ENOMEM;
    a->t = a->y + x->width;
    return QDOT_OK;
}

void
qdot_path_point_end(qdot_path_point *a)
{
    qdot_free(a->y);
    *a = (qdot_path_point){0};
}

void
qdot_path_point_copy(const qdot_path *x, const qdot_path_point *from, qdot_path_point *to)
{
    memcpy(to->y, from->y, (x->width + x->n + 1) * sizeof *to->y);
    to->det = from->det;
    to->growing = from->growing;
    to->flip = from->flip;
    to->rests = from->rests;
    to->blurred = from->blurred;
    to->phase = from->phase;
    to->growth = from->growth;
    to->stability = from->stability;
}

double
qdot_path_end_of(const qdot_path *x, size_t i, bool upper, double p)
{
    return x->end != NULL ? x->end(x, i, upper, p) : upper ? x->hi[i] : x->lo[i];
}

bool
qdot_path_is_inside(const qdot_path *x, const double *y)
{
    bool inside = true;

    for (size_t i = 0; i < x->n && inside; i++)
        inside = y[i] >= qdot_path_end_of(x, i, false, y[x->n]) && y[i] <= qdot_path_end_of(x, i, true, y[x->n]);
    return inside;
}

double
qdot_path_product(const qdot_path *x, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i <= x->n; i++)
        sum += x->weight[i] * a[i] * b[i];
    return sum;
}

double
qdot_path_halves(const qdot_path *x, const double *a, const double *b)
{
    double sum = 0;

    /* all coordinates but the last, which is the period */
    for (size_t i = 0; i + 1 < x->coordinates && x->half > 0; i++)
        sum += x->weight[i] * (a[x->half + i] - a[i]) * (b[x->half + i] - b[i]);
    return x->half > 0 ? sum : 1;
}

double
qdot_path_distance(const qdot_path *x, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i <= x->n; i++) {
        double d = a[i] - b[i];

        if (i < x->n && x->angle[i])
            d -= 2 * M_PI * round(d / (2 * M_PI));
        sum += x->weight[i] * d * d;
    }
    return sqrt(sum);
}

/* Factor the Jacobian J of the latest evaluation, extended by the row g^T below it. */
static bool
factor_extended_jacobian(qdot_path *x, const double *g)
{
    const size_t n = x->n, m = n + 1;

    memcpy(x->A, x->J, n * m * sizeof *x->A);
    memcpy(x->A + n * m, g, m * sizeof *x->A);
    return qdot_lu_factor(m, x->A, x->rows);
}

bool
qdot_path_solve(qdot_path *x, const double *g, double *y, int *steps)
{
    const size_t n = x->n;
    const double near = 1e5 * x->exact;
    double before = INFINITY;

    for (*steps = 1; *steps <= STEPS; ++*steps) {
        double length;

        x->at(x, y);
        for (size_t i = 0; i < n; i++) {
            if (!isfinite(x->F[i]))
                return false;
            x->b[i] = -x->F[i];
        }
        x->b[n] = 0;
        if (!factor_extended_jacobian(x, g))
            return false;
        qdot_lu_solve(n + 1, x->A, x->rows, x->b);
        length = sqrt(qdot_path_product(x, x->b, x->b));
        if (!isfinite(length) || length > 2 * before)
            return false;
        for (size_t i = 0; i <= n; i++)
            y[i] += x->b[i];
        if (length < x->exact || (length < near && length > before / 4))
            return true;
        before = length;
    }
    return before < near;
}

bool
qdot_path_hold(qdot_path *x, size_t i, double *y)
{
    double *const g = qdot_calloc(x->n + 1, sizeof *g);
    const double held = y[i];
    int steps;
    bool good = false;

    if (g == NULL)
        return false;
    g[i] = 1;
    good = qdot_path_solve(x, g, y, &steps);
    y[i] = held;
    qdot_free(g);
    return good;
}

/* The determinant of the matrix that was factored last, from its triangular factors. */
static double
determinant_of_factored(const qdot_path *x)
{
    const size_t m = x->n + 1;
    double det = 1;

    for (size_t k = 0; k < m; k++)
        det *= x->rows[k].pivot != k ? -x->A[k * m + k] : x->A[k * m + k];
    return det;
}

bool
qdot_path_tangent(qdot_path *x, const double *along, qdot_path_point *a)
{
    const size_t n = x->n;
    double length;

    x->at(x, a->y);
    for (size_t i = 0; i <= n; i++)
        x->b[i] = x->weight[i] * along[i];
    if (!factor_extended_jacobian(x, x->b))
        return false;
    a->det = determinant_of_factored(x) / x->gauge;
    x->most_det = fmax(x->most_det, fabs(a->det));
    for (size_t i = 0; i <= n; i++)
        x->b[i] = i == n;
    qdot_lu_solve(n + 1, x->A, x->rows, x->b);
    length = sqrt(qdot_path_product(x, x->b, x->b));
    if (!isfinite(length) || length == 0)
        return false;
    for (size_t i = 0; i <= n; i++)
        a->t[i] = x->b[i] / length;
    return true;
}

bool
qdot_path_go(qdot_path *x, const qdot_path_point *a, double s, qdot_path_point *to,
                  int *steps)
{
    const size_t n = x->n;

    for (size_t i = 0; i <= n; i++) {
        to->y[i] = a->y[i] + s * a->t[i];
        to->t[i] = x->weight[i] * a->t[i];
    }
    return qdot_path_solve(x, to->t, to->y, steps) && qdot_path_tangent(x, a->t, to);
}
