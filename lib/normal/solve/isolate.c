/* isolate.c -- proves zeros of a system by Krawczyk's test in ball arithmetic. */
#include "normal/solve/isolate.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"

enum { BITS = 128, SIZES = 5, STEPS = 10 };

static bool
value_of_unknown(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const qdot_isolate *s = user;

    (void)prec;
    for (size_t i = 0; i < s->n; i++)
        if (s->x[i] == atom) {
            arb_set(value, s->at + i);
            return true;
        }
    return false;
}

qdot_status
qdot_isolate_begin(qdot_isolate *s, qdot_pool *pool, size_t n, const qdot_expr *f,
                   const qdot_expr *x)
{
    qdot_status status;

    *s = (qdot_isolate){.pool = pool, .n = n, .x = x};
    s->f = qdot_calloc(n + n * n + 1, sizeof *s->f);
    s->C = qdot_calloc(2 * n * n + n + 1, sizeof *s->C);
    s->at = qdot_malloc((3 * n + 1) * sizeof *s->at);
    status = s->f == NULL || s->C == NULL || s->at == NULL ? QDOT_ENOMEM : QDOT_OK;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        s->f[i] = f[i];
        for (size_t j = 0; j < n; j++)
            s->f[n + i * n + j] = qdot_diff(pool, f[i], x[j]);
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_ball_begin(&s->ball, pool, n + n * n, s->f);
    if (status != QDOT_OK) {
        qdot_free(s->f);
        qdot_free(s->C);
        qdot_free(s->at);
        return status;
    }
    s->work = s->C + n * n;
    s->unique = s->work + n * n;
    s->y = s->at + n;
    s->z = s->y + n;
    for (size_t i = 0; i < 3 * n; i++)
        arb_init(s->at + i);
    return QDOT_OK;
}

void
qdot_isolate_end(qdot_isolate *s)
{
    for (size_t i = 0; i < 3 * s->n; i++)
        arb_clear(s->at + i);
    qdot_ball_end(&s->ball);
    qdot_free(s->f);
    qdot_free(s->C);
    qdot_free(s->at);
}

/* Evaluate about x0, each component within radius (NULL: at x0 itself); false where something has no
 * value or may jump. */
static bool
evaluate_in_box(qdot_isolate *s, const double *x0, const double *radius)
{
    const qdot_walk *w = &s->ball.walk;

    for (size_t i = 0; i < s->n; i++) {
        arb_set_d(s->at + i, x0[i]);
        if (radius != NULL)
            mag_set_d(arb_radref(s->at + i), radius[i]);
    }
    qdot_ball_eval(&s->ball, BITS, value_of_unknown, s);
    for (size_t i = 0; i < s->n + s->n * s->n; i++)
        if (qdot_ball_get(&s->ball, s->f[i]) == NULL)
            return false;
    for (size_t i = 0; i < w->n && radius != NULL; i++) {
        uint32_t op = qdot_expr_node(s->pool, w->at[i])->op;

        if (qdot_expr_kind(s->pool, w->at[i]) != QDOT_FUN ||
            (op != QDOT_FLOOR && op != QDOT_MOD && op != QDOT_MIN && op != QDOT_MAX))
            continue;
        if (op != QDOT_FLOOR || !arb_is_exact(s->ball.value + i))
            return false;
    }
    return true;
}

/* Compute C = A^-1 by Gauss-Jordan elimination with the largest pivot; false if A is singular in doubles. */
static bool
invert_matrix(size_t n, double *A, double *C)
{
    memset(C, 0, n * n * sizeof *C);
    for (size_t i = 0; i < n; i++)
        C[i * n + i] = 1;
    for (size_t c = 0; c < n; c++) {
        size_t p = c;
        double pivot;

        for (size_t i = c + 1; i < n; i++)
            if (fabs(A[i * n + c]) > fabs(A[p * n + c]))
                p = i;
        pivot = A[p * n + c];
        if (!(fabs(pivot) > 0) || !isfinite(pivot))
            return false;
        for (size_t k = 0; k < n; k++) {
            double a = A[p * n + k], b = C[p * n + k];

            A[p * n + k] = A[c * n + k];
            C[p * n + k] = C[c * n + k];
            A[c * n + k] = a / pivot;
            C[c * n + k] = b / pivot;
        }
        for (size_t i = 0; i < n; i++) {
            double by = A[i * n + c];

            for (size_t k = 0; i != c && by != 0 && k < n; k++) {
                A[i * n + k] -= by * A[c * n + k];
                C[i * n + k] -= by * C[c * n + k];
            }
        }
    }
    return true;
}

static double
midpoint(arb_srcptr v)
{
    return arf_get_d(arb_midref(v), ARF_RND_NEAR);
}

/* Compute the Newton step y = C f(x0), with C the inverse of the Jacobian. */
static bool
compute_newton_step(qdot_isolate *s, const double *x0)
{
    size_t n = s->n;
    arb_t c;

    if (!evaluate_in_box(s, x0, NULL))
        return false;
    for (size_t i = 0; i < n * n; i++)
        s->work[i] = midpoint(qdot_ball_get(&s->ball, s->f[n + i]));
    if (!invert_matrix(n, s->work, s->C))
        return false;
    arb_init(c);
    for (size_t i = 0; i < n; i++) {
        arb_zero(s->y + i);
        for (size_t j = 0; j < n; j++) {
            arb_set_d(c, s->C[i * n + j]);
            arb_addmul(s->y + i, c, qdot_ball_get(&s->ball, s->f[j]), BITS);
        }
    }
    arb_clear(c);
    return true;
}

/* Newton's steps from x0 until they end at rounding; s->y and C at the last x0. Where they hardly shorten, x0 is near a
 * multiple zero or none. */
static bool
iterate_newton(qdot_isolate *s, double *x0)
{
    double before = INFINITY;

    for (int k = 0; k <= STEPS; k++) {
        double length = 0;

        if (!compute_newton_step(s, x0))
            return false;
        for (size_t i = 0; i < s->n; i++)
            length = fmax(length, fabs(midpoint(s->y + i)) / fmax(fabs(x0[i]), 1e-3));
        if (k == STEPS || (k >= 3 && !(length > 2 * DBL_EPSILON && length < before / 4)))
            break;
        for (size_t i = 0; i < s->n; i++)
            x0[i] -= midpoint(s->y + i);
        before = length;
    }
    return true;
}

/* Whether the Krawczyk image K of the box x0 +- radius lies inside the box; s->z is K - x0. */
static bool
image_is_inside(qdot_isolate *s, const double *x0, const double *radius)
{
    size_t n = s->n;
    bool inside = evaluate_in_box(s, x0, radius);
    arb_t c, d, r;

    arb_init(c);
    arb_init(d);
    arb_init(r);
    for (size_t i = 0; i < n && inside; i++) {
        arb_neg(s->z + i, s->y + i);
        for (size_t j = 0; j < n; j++) {
            arb_set_si(d, i == j);
            for (size_t k = 0; k < n; k++) {
                if (s->f[n + k * n + j] == QDOT_ZERO)
                    continue;
                arb_set_d(c, s->C[i * n + k]);
                arb_submul(d, c, qdot_ball_get(&s->ball, s->f[n + k * n + j]), BITS);
            }
            arb_zero(r);
            mag_set_d(arb_radref(r), radius[j]);
            arb_addmul(s->z + i, d, r, BITS);
        }
        arb_abs(d, s->z + i);
        arb_set_d(c, radius[i]);
        inside = arb_lt(d, c);
    }
    arb_clear(c);
    arb_clear(d);
    arb_clear(r);
    return inside;
}

bool
qdot_isolate_prove(qdot_isolate *s, double *x0, double *radius)
{
    size_t n = s->n;
    double grow = 1;

    if (!iterate_newton(s, x0))
        return false;
    for (int size = 0; size < SIZES; size++, grow *= 1e3) {
        double *r = radius;

        for (size_t i = 0; i < n; i++)
            r[i] = grow * (4 * fabs(midpoint(s->y + i)) + 1e-14 * fmax(fabs(x0[i]), 1e-3));
        if (!image_is_inside(s, x0, r))
            continue;
        for (size_t i = 0; i < n; i++) {
            mag_t most;

            s->unique[i] = r[i];
            mag_init(most);
            arb_get_mag(most, s->z + i);
            radius[i] = mag_get_d(most) * 1.0000001;
            mag_clear(most);
        }
        return true;
    }
    return false;
}
