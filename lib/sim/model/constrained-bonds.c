/* constrained-bonds.c -- residuals and slopes of holonomic constraints for methods that enforce
 * them in their steps. */
#include "sim/model/constrained.h"

#include <string.h>

#include "sim/model/constrained-parts.h"

static void
load_state(qdot_constrained *h, double t, const double *q, const double *v)
{
    const size_t n = h->plan->n;

    memcpy(h->in, q, n * sizeof *q);
    if (v)
        memcpy(h->in + n, v, n * sizeof *v);
    h->in[2 * n] = t;
}

static qdot_status
position_residuals(double t, const double *q, double *g, void *user)
{
    qdot_constrained *h = user;

    load_state(h, t, q, NULL);
    qdot_tape_eval(qdot_constrained_tape(h->positions, h->c->positions), h->in, g,
                   h->work);
    return QDOT_OK;
}

static qdot_status
velocity_residuals(double t, const double *q, const double *v, double *w, void *user)
{
    qdot_constrained *h = user;

    load_state(h, t, q, v);
    qdot_tape_eval(qdot_constrained_tape(h->velocities, h->c->velocities), h->in, w,
                   h->work);
    return QDOT_OK;
}

static qdot_status
constraint_forces(double t, const double *q, const double *lambda, double *F, void *user)
{
    qdot_constrained *h = user;
    const qdot_constraints *c = h->c;
    const double *slope;

    load_state(h, t, q, NULL);
    qdot_tape_eval(qdot_constrained_tape(h->metric, c->metric), h->in, h->out, h->work);
    slope = h->out + c->n_masses;
    for (size_t k = 0; k < c->n_slopes; k++)
        F[c->slopes[k].column] += slope[k] * lambda[c->slopes[k].row];
    return QDOT_OK;
}

static qdot_status
factor_at_positions(double t, const double *q, void *user)
{
    qdot_constrained *h = user;

    load_state(h, t, q, NULL);
    return qdot_constrained_factor_metric(h, h->at[QDOT_HOLONOMIC]);
}

static void
solve_for_correction(double *c, double *nu, double *x, void *user)
{
    qdot_constrained *h = user;
    qdot_constrained_level *l = h->at[QDOT_HOLONOMIC];
    const size_t n = h->plan->n;

    if (l->moves) {
        qdot_least_move_solve(&l->move, c, x);
        memcpy(nu, c, l->m * sizeof *nu);
        return;
    }
    memset(l->saddle.x, 0, n * sizeof *x);
    memcpy(l->saddle.x + n, c, l->m * sizeof *c);
    qdot_saddle_solve(&l->saddle);
    memcpy(x, l->saddle.x, n * sizeof *x);
    for (size_t k = 0; k < l->m; k++)
        nu[k] = -l->saddle.x[n + k];
}

qdot_ode_bonds
qdot_constrained_bonds(qdot_constrained *h)
{
    return (qdot_ode_bonds){h->c->m, position_residuals, velocity_residuals, constraint_forces, factor_at_positions, solve_for_correction, h};
}
