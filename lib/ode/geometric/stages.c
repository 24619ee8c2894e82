/* stages.c -- implicit stages of a collocation method: coefficients, first guess, iteration. */
#include "ode/geometric/stages.h"

#include <math.h>
#include <string.h>

#include "ode/scale.h"

enum { most_iterations = 60, least_iterations = 3 };

/* The iteration has failed if changes stop decreasing while above this, relative to the positions. */
static const double converged = 1e-10;

/* A coordinate that is nothing but rounding of the others never settles: below this fraction of its scale
 * it counts as so large. */
static const double smallest = 1e-6;

qdot_stages
qdot_stages_of(const qdot_geometric *g)
{
    const size_t s = (size_t)g->kernel->stages, n = g->n;
    double *at = g->work;
    qdot_stages w = {.s = s, .n = n, .a = at};

    w.b = w.a + 2 * s * s;
    w.c = w.b + 2 * s;
    w.ahead = w.c + s;
    w.F = w.ahead + s * s;
    w.W = w.F + s * n;
    w.X = w.W + s * n;
    w.p = w.X + s * n;
    w.rest = w.p + n;
    return w;
}

void
qdot_stages_begin(const qdot_stages *w, const qdot_collocation *m)
{
    const size_t s = w->s;

    for (size_t i = 0; i < s; i++) {
        w->b[i] = m->b[i].hi;
        w->b[s + i] = m->b[i].lo;
        w->c[i] = m->c[i].hi;
        for (size_t j = 0; j < s; j++) {
            double x = 0;

            w->a[i * s + j] = m->a[i][j].hi;
            w->a[s * s + i * s + j] = m->a[i][j].lo;
            for (size_t k = s; k-- > 0;)
                x = x * (1 + m->c[i].hi) + m->l[j][k].hi;
            w->ahead[i * s + j] = x;
        }
    }
}

void
qdot_stages_go_on(size_t s, size_t n, const double *ahead, double *x)
{
    double column[QDOT_COLLOCATION_MOST];

    for (size_t k = 0; k < n; k++) {
        for (size_t i = 0; i < s; i++) {
            column[i] = 0;
            for (size_t j = 0; j < s; j++)
                column[i] += ahead[i * s + j] * x[j * n + k];
        }
        for (size_t i = 0; i < s; i++)
            x[i * n + k] = column[i];
    }
}

qdot_status
qdot_stages_guess(qdot_geometric *g, const qdot_stages *w, double t, double h)
{
    const size_t s = w->s, n = w->n;

    if (g->known && h == g->h) {
        qdot_stages_go_on(s, n, w->ahead, w->W);
        qdot_stages_go_on(s, n, w->ahead, w->F);
    } else {
        QDOT_TRY(qdot_geometric_velocity(g, t, g->y, g->y + n, w->W));
        QDOT_TRY(qdot_geometric_force(g, t, g->y, w->W, w->F));
        for (size_t i = 1; i < s; i++) {
            memcpy(w->W + i * n, w->W, n * sizeof *w->W);
            memcpy(w->F + i * n, w->F, n * sizeof *w->F);
        }
    }
    qdot_stages_move(g, w, h);
    return QDOT_OK;
}

double
qdot_stages_move(const qdot_geometric *g, const qdot_stages *w, double h)
{
    const size_t n = w->n;
    double most = 0;

    for (size_t i = 0; i < w->s; i++)
        for (size_t k = 0; k < n; k++) {
            const double x = qdot_stages_at(w, w->a, i, g->y[k], g->low[k], h, w->W, k);
            const double change = fabs(x - w->X[i * n + k]);
            const double size =
                fmax(fabs(g->y[k]) + fabs(x - g->y[k]),
                     smallest * qdot_ode_size(g->system->scales, k, g->y[k]));

            w->X[i * n + k] = x;
            if (!(change <= most * size))
                most = change / size;
        }
    return most;
}

qdot_status
qdot_stages_iterate(qdot_geometric *g, const qdot_stages *w, double t, double h,
                    int patience, qdot_stages_once *once)
{
    double least = INFINITY, change;
    int idle = 0;

    for (int k = 1;; k++) {
        QDOT_TRY(once(g, w, t, h, &change));
        idle = change < least ? 0 : idle + 1;
        if (k >= least_iterations && change < converged &&
            (change == 0 || idle >= patience))
            return QDOT_OK;
        if (k == most_iterations || !isfinite(change))
            return qdot_fail(QDOT_EDOMAIN, "the stages of a step of %.2g do not converge",
                             h);
        least = fmin(least, change);
    }
}
