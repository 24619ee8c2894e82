/* zeros-near.c -- finds the zero that Newton's method reaches from a guess, and proves it. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/exact.h"
#include "normal/solve/zeros-parts.h"
#include "num/lu.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, STEPS = 200, HALVINGS = 30 };

/* The size of f at z: its largest component, relative to that component at the guess; INFINITY if undefined. */
static double
size_of_function(qdot_zeros_system *s, const double *z, const double *unit, double *f)
{
    qdot_interval X[MOST];
    double most = 0;

    for (size_t i = 0; i < s->n; i++)
        X[i] = qdot_interval_point(z[i]);
    qdot_enclosure_eval(s->bounds, X, true);
    for (size_t i = 0; i < s->n; i++) {
        const qdot_enclosure_value *v = qdot_enclosure_get(s->bounds, i);

        f[i] = v->y.lo / 2 + v->y.hi / 2;
        if (v->state == QDOT_ENCLOSURE_NOWHERE || !isfinite(f[i]))
            return INFINITY;
        most = fmax(most, fabs(f[i]) / unit[i]);
    }
    return most;
}

/* Compute Newton's step -f'^-1 f at the point of the latest evaluation; false where the Jacobian f' is singular. */
static bool
newton_step(const qdot_zeros_system *s, const double *f, double *step)
{
    double J[MOST * MOST];
    qdot_lu_row rows[MOST];

    for (size_t i = 0; i < s->n; i++) {
        const qdot_enclosure_value *v = qdot_enclosure_get(s->bounds, i);

        step[i] = -f[i];
        for (size_t j = 0; j < s->n; j++)
            J[i * s->n + j] = v->slope[j].lo / 2 + v->slope[j].hi / 2;
    }
    if (!qdot_lu_factor(s->n, J, rows))
        return false;
    qdot_lu_solve(s->n, J, rows, step);
    for (size_t i = 0; i < s->n; i++)
        if (!isfinite(step[i]))
            return false;
    return true;
}

/* Apply Newton's method from z, with steps halved until f becomes smaller; true if it converges. */
static bool
iterate_newton(qdot_zeros_system *s, double *z)
{
    double unit[MOST], f[MOST], step[MOST], next[MOST], size;

    for (size_t i = 0; i < s->n; i++)
        unit[i] = 1;
    size = size_of_function(s, z, unit, f);
    for (size_t i = 0; i < s->n; i++)
        unit[i] = f[i] != 0 && isfinite(f[i]) ? fabs(f[i]) : 1;
    size = size_of_function(s, z, unit, f);
    for (int k = 0; k < STEPS && isfinite(size) && size > 0; k++) {
        double by = 1, length = 0, after = INFINITY;

        if (!newton_step(s, f, step))
            return k > 0;
        for (int h = 0; h < HALVINGS; h++, by /= 2) {
            for (size_t i = 0; i < s->n; i++)
                next[i] = z[i] + by * step[i];
            after = size_of_function(s, next, unit, f);
            if (after < size)
                break;
        }
        if (!(after < size)) /* no step makes f smaller, because of rounding or since f cannot become smaller here: stop */
            return true;
        for (size_t i = 0; i < s->n; i++)
            length = fmax(length, fabs(by * step[i]) / fmax(fabs(next[i]), 1e-300));
        memcpy(z, next, s->n * sizeof *z);
        size = after;
        if (length < 1e-15)
            return true;
    }
    return size == 0;
}

/* A multiple zero, or one at a kink, of one unknown: the nearest in a small box about z, where steps from
 * the guess ended. */
static qdot_status
search_near(qdot_pool *pool, const qdot_expr *F, const qdot_expr *x, double guess,
            double z, qdot_zeros *out)
{
    double reach = 1e-2 * fabs(guess - z) + 1e-6 * fmax(fabs(z), 1e-3);
    qdot_zeros_range range = {.lo = qdot_expr_of_double(pool, z - reach),
                              .hi = qdot_expr_of_double(pool, z + reach)};
    size_t best = 0;

    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_zeros_find(pool, 1, F, x, &range, 0, out));
    out->complete = out->exhausted = false; /* not complete: only a small box was searched */
    for (size_t k = 1; k < out->count; k++)
        if (fabs(out->at[k] - z) < fabs(out->at[best] - z))
            best = k;
    if (out->count > 1) {
        out->at[0] = out->at[best];
        out->radius[0] = out->radius[best];
        out->simple[0] = out->simple[best];
        out->count = 1;
    }
    return QDOT_OK;
}

qdot_status
qdot_zeros_near(qdot_pool *pool, size_t n, const qdot_expr *F, const qdot_expr *x,
                const double *guess, qdot_zeros *out)
{
    double z[MOST];
    qdot_zeros_system s;
    qdot_zero_place place;
    bool ends, proved = false;

    *out = (qdot_zeros){.n = n};
    if (n == 0 || n > MOST)
        return qdot_fail(QDOT_ETYPE, "zeros are searched in 1 to %d unknowns", MOST);
    QDOT_TRY(qdot_interrupt_check());
    memcpy(z, guess, n * sizeof *z);
    QDOT_TRY(qdot_zeros_system_begin(&s, pool, n, F, x));
    ends = iterate_newton(&s, z);
    if (ends)
        proved = qdot_zeros_prove(&s, z, &place);
    qdot_zeros_system_end(&s);
    if (!proved)
        return ends && n == 1 ? search_near(pool, F, x, guess[0], z[0], out) : QDOT_OK;
    out->at = qdot_calloc(2 * n, sizeof *out->at);
    out->simple = qdot_calloc(1, sizeof *out->simple);
    if (out->at == NULL || out->simple == NULL) {
        qdot_zeros_clear(out);
        return QDOT_ENOMEM;
    }
    out->radius = out->at + n;
    out->count = 1;
    out->simple[0] = true;
    memcpy(out->at, place.at, n * sizeof *out->at);
    memcpy(out->radius, place.radius, n * sizeof *out->radius);
    return QDOT_OK;
}
