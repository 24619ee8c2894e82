/* saddle-solver.c -- solves [M A^T; A 0]; measures the constraints' independence, also along the step. */
#include "sim/form/saddle-solver.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/taylor-motion.h"
#include "sim/model/constrained.h"

/* Constraints are nearly dependent if their independence falls below this fraction of its largest value. */
static const double nearly = 0.3;

/* Of what is left of their independence now, where a place ahead at which nothing is is believed:
 * what Newton's method leaves there, and the highest of the orders it looks at. */
static const double settled = 1e-6, shown = 0.5;

/* Prepare the solver; the motion's matrix entries are those of M, followed by those of A. */
qdot_status
qdot_saddle_solver_init(qdot_saddle_solver *s, const qdot_plan *plan, const qdot_taylor *series)
{
    const qdot_constraints *c = plan->constraints;
    const size_t entries = c->n_masses + c->n_slopes;

    *s = (qdot_saddle_solver){.plan = plan};
    s->M = qdot_calloc(entries + 1, sizeof *s->M);
    s->weak = qdot_calloc(c->m + plan->n, sizeof *s->weak);
    if (!s->M || !s->weak)
        return QDOT_ENOMEM;
    s->A = s->M + c->n_masses;
    for (size_t i = 0; i < entries; i++)
        s->M[i].series =
            qdot_taylor_entry(series, c->motion.entries.at[i].at, &s->M[i].sign);
    QDOT_TRY(qdot_saddle_init(&s->matrix, plan->n, c->m, plan->indefinite));
    return qdot_saddle_pattern(&s->matrix, c->n_masses, c->masses, c->n_slopes, c->slopes);
}

void
qdot_saddle_solver_clear(qdot_saddle_solver *s)
{
    qdot_saddle_clear(&s->matrix);
    qdot_free(s->M);
    qdot_free(s->weak);
}

static double
value_of_entry(const qdot_saddle_series *entry)
{
    return entry->sign * entry->series[0];
}

qdot_status
qdot_saddle_solver_factor(qdot_saddle_solver *s)
{
    const qdot_constraints *c = s->plan->constraints;
    const size_t n = s->plan->n;

    for (size_t k = 0; k < c->n_masses; k++) {
        const size_t i = c->masses[k].row, j = c->masses[k].column;

        s->matrix.M[i * n + j] = s->matrix.M[j * n + i] = value_of_entry(s->M + k);
    }
    for (size_t k = 0; k < c->n_slopes; k++)
        s->matrix.A[c->slopes[k].row * n + c->slopes[k].column] = value_of_entry(s->A + k);
    return qdot_constrained_factor(s->plan, &s->matrix);
}

qdot_status
qdot_saddle_solver_look(qdot_saddle_solver *s, double t, const double *y)
{
    const size_t n = s->plan->n;
    double *in;
    qdot_status status;

    if (s->matrix.m < 2 || s->matrix.rank != QDOT_SADDLE_UNKNOWN)
        return QDOT_OK;
    in = qdot_malloc((2 * n + 1) * sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    memcpy(in, y, 2 * n * sizeof *in);
    in[2 * n] = t;
    status = qdot_constrained_look_beside(s->plan, &s->matrix, NULL, in);
    qdot_free(in);
    return status;
}

/* Near a place where the constraints are dependent a direction of the accelerations is
 * found by dividing rounding by what is left of their independence, twice over: the slope
 * of the constraints is as uncertain. Each order adds one more such division, which the
 * length of the step balances. */
double
qdot_saddle_solver_noise(qdot_saddle_solver *s)
{
    double left;

    if (s->matrix.direct)
        return 0;
    s->best = fmax(s->best, s->matrix.quality);
    left = s->matrix.quality / s->best;
    return left < nearly ? fmin(1e-9, 100 * DBL_EPSILON / (left * left)) : 0;
}

/* The weakest combination of rows, along its own direction, is a scalar series that passes
 * 0 where they are dependent; its first root, from the lowest orders, if these show one. */
double
qdot_saddle_solver_ahead(qdot_saddle_solver *s, double unit)
{
    const qdot_constraints *c = s->plan->constraints;
    double sigma[4] = {0}, at, left, *row = s->weak, *column = s->weak + c->m;

    if (s->matrix.rank == 0)
        return 0;
    qdot_saddle_weakest(&s->matrix, row, column);
    for (size_t k = 0; k < c->n_slopes; k++)
        for (int j = 0; j < 4; j++)
            sigma[j] += s->A[k].sign * row[c->slopes[k].row] *
                        column[c->slopes[k].column] * s->A[k].series[j];
    at = -sigma[0] / sigma[1];
    for (int k = 0; k < 20; k++) {
        double f = sigma[0] + at * (sigma[1] + at * (sigma[2] + at * sigma[3]));

        at -= f / (sigma[1] + at * (2 * sigma[2] + at * 3 * sigma[3]));
    }
    left = sigma[0] + at * (sigma[1] + at * (sigma[2] + at * sigma[3]));
    if (!(at > 0 && fabs(left) < settled * fabs(sigma[0])
          && fabs(at * at * at * sigma[3]) < shown * fabs(sigma[0])))
        return 0;
    return at * fabs(unit);
}
