/* gauss.c -- Gauss collocation of orders 4, 6, 8 and 12 in (q, p).
 *
 *     P_i = p + h sum_j a_ij F_j,   X_i = q + h sum_j a_ij W_j,   i = 1 .. s   (stages.h)
 *     p <- p + h sum_i b_i F_i,     q <- q + h sum_i b_i W_i
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.3; num/collocation.h.
 */
#include "ode/geometric/stages.h"

static void
begin_gauss(qdot_geometric *g)
{
    const qdot_stages w = qdot_stages_of(g);
    qdot_collocation m;

    qdot_collocation_gauss(g->kernel->stages, &m);
    qdot_stages_begin(&w, &m);
}

/* Iterate once for the stages: update their momenta P, velocities W, positions X and forces F. */
static qdot_status
iterate_stages(qdot_geometric *g, const qdot_stages *w, double t, double h, double *change)
{
    const size_t n = w->n;

    for (size_t i = 0; i < w->s; i++) {
        for (size_t k = 0; k < n; k++)
            w->p[k] = qdot_stages_at(w, w->a, i, g->y[n + k], g->low[n + k], h, w->F, k);
        QDOT_TRY(qdot_geometric_velocity(g, t + w->c[i] * h, w->X + i * n, w->p,
                                         w->W + i * n));
    }
    *change = qdot_stages_move(g, w, h);
    for (size_t i = 0; i < w->s; i++)
        QDOT_TRY(qdot_geometric_force(g, t + w->c[i] * h, w->X + i * n, w->W + i * n,
                                      w->F + i * n));
    return QDOT_OK;
}

static qdot_status
gauss(qdot_geometric *g, double t, double h)
{
    const qdot_stages w = qdot_stages_of(g);
    const size_t n = w.n;

    QDOT_TRY(qdot_stages_guess(g, &w, t, h));
    g->known = false;
    QDOT_TRY(qdot_stages_iterate(g, &w, t, h, 1, iterate_stages));
    for (size_t k = 0; k < n; k++) {
        qdot_stages_advance(&w, &g->y[k], &g->low[k], h, w.W, k);
        qdot_stages_advance(&w, &g->y[n + k], &g->low[n + k], h, w.F, k);
    }
    g->known = true;
    return QDOT_OK;
}

#define GAUSS(order, s)                                                                  \
    const qdot_geometric_kernel qdot_gauss##order = {                                    \
        order, false, s, QDOT_STAGES_ROWS(s), QDOT_STAGES_MORE(s), 0, begin_gauss, gauss};

GAUSS(4, 2)
GAUSS(6, 3)
GAUSS(8, 4)
GAUSS(12, 6)
