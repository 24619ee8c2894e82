/* splitting.c -- Stoermer-Verlet, and its composition to order 8, for H = T(p) + V(q, t).
 *
 *     p <- p + h/2 F(t, q),   q <- q + h p,   p <- p + h/2 F(t + h, q)
 *
 * One evaluation a stage: that of its end begins the next.
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, I.1.4, V.3.2, VIII.5.
 */
#include "ode/geometric/splitting.h"

#include "num/sum.h"
#include "ode/geometric/geometric.h"

static const double gamma_of[] = {
#define GAMMA(g) g,
#include "ode/geometric/composition.def"
#undef GAMMA
};

void
qdot_composition_lengths(double h, double *length, double *rest)
{
    qdot_sum sum = {.sum = -h};

    for (int i = 0; i < QDOT_COMPOSITION_STAGES; i++) {
        length[i] = gamma_of[i < QDOT_COMPOSITION_STAGES / 2 ? i
                                                             : QDOT_COMPOSITION_STAGES - 1 - i]
                    * h;
        qdot_sum_add(&sum, length[i]);
    }
    *rest = -qdot_sum_value(&sum);
}

/* Add the terms a d and b d to the sum of two doubles x + low, component by component. */
static void
add_scaled_vector(size_t n, double *x, double *low, double a, double b, const double *d)
{
    for (size_t i = 0; i < n; i++)
        qdot_sum_advance_by(&x[i], &low[i], a * d[i], b * d[i]);
}

/* Make all stages with the given lengths, the middle one longer by `rest`; g->work holds the force F at the state. */
static qdot_status
make_splitting_stages(qdot_geometric *g, double t, int stages, const double *length, double rest)
{
    const size_t n = g->n;
    double *q = g->y, *p = q + n, *q_low = g->low, *p_low = q_low + n, *F = g->work;

    if (!g->known)
        QDOT_TRY(qdot_geometric_force(g, t, q, p, F));
    g->known = false;
    for (int s = 0; s < stages; s++) {
        const double h = length[s], more = s == stages / 2 ? rest : 0;

        add_scaled_vector(n, p, p_low, 0.5 * h, 0.5 * more, F);
        add_scaled_vector(n, q, q_low, h, more, p);
        t += h;
        QDOT_TRY(qdot_geometric_force(g, t, q, p, F));
        add_scaled_vector(n, p, p_low, 0.5 * h, 0.5 * more, F);
    }
    g->known = true;
    return QDOT_OK;
}

static qdot_status
verlet(qdot_geometric *g, double t, double h)
{
    return make_splitting_stages(g, t, 1, &h, 0);
}

static qdot_status
make_composition_step(qdot_geometric *g, double t, double h)
{
    double length[QDOT_COMPOSITION_STAGES], rest;

    qdot_composition_lengths(h, length, &rest);
    return make_splitting_stages(g, t, QDOT_COMPOSITION_STAGES, length, rest);
}

const qdot_geometric_kernel qdot_verlet = {2, true, 0, 1, 0, 0, NULL, verlet};
const qdot_geometric_kernel qdot_composition8 = {8, true, 0, 1, 0, 0, NULL, make_composition_step};
