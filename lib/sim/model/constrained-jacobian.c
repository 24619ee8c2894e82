/* constrained-jacobian.c -- derivatives of q'' under constraints, from the derivatives of the tapes. */
#include <string.h>

#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"
#include "tape/derivative.h"

/* Add c times row `from` of a tape's derivatives to row `row` of h->gains (derivatives of the equations). */
static void
add_to_gains(qdot_constrained *h, size_t row, double c, size_t from)
{
    const size_t columns = 2 * h->plan->n + 1;

    for (size_t j = 0; j < columns; j++)
        h->gains[row * columns + j] += c * h->slopes[from * columns + j];
}

/* Find the derivatives of the equations by q, q', t at constant q'' and lambda, into h->gains. */
static void
find_explicit_derivatives(qdot_constrained *h)
{
    const qdot_constraints *c = h->c;
    const size_t n = h->plan->n, columns = 2 * n + 1;
    const double *a = h->a, *lambda = h->a + n;
    size_t from = n;

    memset(h->gains, 0, (n + c->m) * columns * sizeof *h->gains);
    qdot_derivative_eval(qdot_constrained_tape(h->equations, h->plan->tape), h->in, 0,
                         columns, h->out, h->slopes, h->slopes_work);
    for (size_t i = 0; i < n; i++)
        add_to_gains(h, i, 1, i);
    for (size_t k = 0; k < c->n_masses; k++, from++) {
        add_to_gains(h, c->masses[k].row, -a[c->masses[k].column], from);
        if (c->masses[k].row != c->masses[k].column)
            add_to_gains(h, c->masses[k].column, -a[c->masses[k].row], from);
    }
    for (size_t s = 0; s < c->n_slopes; s++, from++) {
        add_to_gains(h, c->slopes[s].column, lambda[c->slopes[s].row], from);
        add_to_gains(h, n + c->slopes[s].row, -a[c->slopes[s].column], from);
    }
    for (size_t k = 0; k < c->m; k++)
        add_to_gains(h, n + k, 1, from++);
}

/* Add what Baumgarte's damping contributes to the derivatives (see qdot_constrained_damp). */
static void
add_damping_derivatives(qdot_constrained *h)
{
    const qdot_constraints *c = h->c;
    const size_t n = h->plan->n, columns = 2 * n + 1;
    const double a = QDOT_CONSTRAINED_RATE;
    size_t from = 0;

    qdot_derivative_eval(qdot_constrained_tape(h->positions, c->positions), h->in, 0,
                         columns, h->out, h->slopes, h->slopes_work);
    for (size_t k = 0; k < c->m; k++)
        if (c->rows[k].kind == QDOT_HOLONOMIC)
            add_to_gains(h, n + k, -a * a, from++);
    qdot_derivative_eval(qdot_constrained_tape(h->velocities, c->velocities), h->in, 0,
                         columns, h->out, h->slopes, h->slopes_work);
    from = 0;
    for (size_t k = 0; k < c->m; k++)
        if (c->rows[k].kind != QDOT_ACCELERATION)
            add_to_gains(h, n + k, c->rows[k].kind == QDOT_HOLONOMIC ? -2 * a : -a, from++);
}

void
qdot_constrained_gains(qdot_constrained *h)
{
    find_explicit_derivatives(h);
    if (h->plan->treatment == QDOT_RUN_BAUMGARTE)
        add_damping_derivatives(h);
}

qdot_status
qdot_constrained_jacobian(qdot_constrained *h, double t, const double *y, double *dfdy,
                          double *dfdt)
{
    const size_t n = h->plan->n, m = h->c->m, columns = 2 * n + 1;
    qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;

    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, h->a + n));
    qdot_constrained_gains(h);
    memset(dfdy, 0, 4 * n * n * sizeof *dfdy);
    memset(dfdt, 0, 2 * n * sizeof *dfdt);
    for (size_t i = 0; i < n; i++)
        dfdy[i * 2 * n + n + i] = 1;
    for (size_t j = 0; j < columns; j++) {
        for (size_t i = 0; i < n + m; i++)
            s->x[i] = h->gains[i * columns + j];
        qdot_saddle_solve(s);
        for (size_t i = 0; i < n; i++)
            *(j < 2 * n ? &dfdy[(n + i) * 2 * n + j] : &dfdt[n + i]) = s->x[i];
    }
    return QDOT_OK;
}
