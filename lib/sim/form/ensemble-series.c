/* ensemble-series.c -- expands the motion of eight ensemble members in vector lanes, order by order. */
#include "sim/form/ensemble-series.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "series/lanes-motion.h"
#include "series/lanes-near.h"
#include "sim/form/residual.h"
#include "sim/model/constrained-lanes.h"
#include "tape/shake.h"

enum { L = QDOT_LANES, most_order = 44 };

/* A block of unknowns that are coupled by the matrix K. */
typedef struct {
    size_t first, n, positive; /* first unknown; number of unknowns; how many of them, from the first on, are accelerations */
    double *A, *inverse;       /* [n x n groups of lanes] the matrix K, then its factors; its inverse */
    double *x;                 /* [n groups of lanes] right-hand side and solution */
} solver;

struct qdot_ensemble_series {
    const qdot_plan *plan;
    size_t n, numbers; /* number of coordinates that move; number of parameters that differ between members */
    const qdot_batch_kernels *kernels;
    const qdot_motion *motion; /* series program of d'Alembert's residual if that form is used, else of M q'' = f */
    qdot_lanes *lanes;
    qdot_constrained_lanes *held; /* constraint solver; NULL: there are no constraints */
    size_t stride;                /* distance of two rows of coefficients, in groups of lanes */
    double *q, *v, *t;            /* Taylor coefficients of the inputs; after t those of constants */
    solver *solvers;              /* [blocks] a solver for each block of K */
    size_t blocks;
    double *by; /* [solved groups of lanes] corrections of the unknowns */
    double unit[L];
    bool shaken;
    qdot_tape *shaken_masses; /* tape of M with slightly perturbed constants, for a residual; NULL: the plan's own tape */
    double *in, *out, *work;  /* inputs, outputs and scratch of the tape of M, in groups of lanes */
    qdot_lanes_motion *code;  /* generated machine code; NULL: the compiled kernels are used */
};

/* --- one stage of the expansion ------------------------------------------------------ */

/* Whether the block has two unknowns; then its matrix is inverted by a formula. */
static bool
is_pair_of_unknowns(const solver *s)
{
    return s->n == 2 && s->positive == 2;
}

static bool
uses_residual(const qdot_plan *p)
{
    return p->residual && p->residual->masses && !p->constraints && !p->indefinite;
}

/* Read the lower triangle of block b of K from a tape's outputs, *at, where the program has no rows
 * for it; advances *at. */
static void
copy_mass_entries(const qdot_ensemble_series *e, size_t b, const double **at)
{
    const qdot_plan_block *block = e->plan->blocks + b;
    const size_t n = block->n;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double *to = e->solvers[b].A + (i * n + j) * L;

            for (size_t l = 0; l < L; l++)
                to[l] = !block->constant ? *(*at)++
                        : e->shaken      ? qdot_shake_double(block->M[i * n + j],
                                                             block->side[i * n + j])
                                         : block->M[i * n + j];
        }
}

static void
evaluate_mass_tape(const qdot_ensemble_series *e, const double *t, const double *y)
{
    const double *at = e->out;

    memcpy(e->in, y, 2 * e->n * L * sizeof *y);
    memcpy(e->in + 2 * e->n * L, t, L * sizeof *t);
    qdot_lanes_eval_near(e->shaken ? e->shaken_masses : e->plan->residual->masses, e->in,
                         e->out, e->work);
    for (size_t b = 0; b < e->blocks; b++)
        copy_mass_entries(e, b, &at);
}

static void
factor_block(const qdot_ensemble_series *e, const solver *s)
{
    const qdot_motion *m = e->motion;

    if (!e->out)
        memset(s->A, 0, s->n * s->n * L * sizeof *s->A);
    for (size_t k = 0; k < m->entries.n; k++) {
        const qdot_motion_entry *x = m->entries.at + k;
        /* an index below the block's first wraps and is larger than n */
        const size_t i = x->i - s->first, j = x->j - s->first;

        if (i < s->n && j < s->n)
            memcpy(s->A + (i * s->n + j) * L, qdot_lanes_series(e->lanes, x->at),
                   L * sizeof *s->A);
    }
    if (is_pair_of_unknowns(s))
        e->kernels->invert_two(s->A, s->inverse);
    else
        e->kernels->factor(s->n, s->positive, s->A);
}

/* Compute order k of the series: evaluate the program, then solve for the unknowns (factors or inverse of K). */
static void
compute_order(qdot_ensemble_series *e, int k)
{
    const qdot_motion *m = e->motion;

    qdot_lanes_stage(e->lanes, k);
    if (k < 0)
        return;
    for (size_t b = 0; b < e->blocks; b++) {
        const solver *s = e->solvers + b;
        const bool inverted = k > 0 || is_pair_of_unknowns(s);
        double *by = e->by + s->first * L, *x = inverted ? s->x : by;

        for (size_t i = 0; i < s->n; i++) {
            const double *E = qdot_lanes_series(e->lanes, m->equations.at[s->first + i]) + k * L;

            for (size_t l = 0; l < L; l++)
                x[i * L + l] = -E[l];
        }
        if (k == 0)
            factor_block(e, s);
        if (inverted)
            e->kernels->multiply(s->n, s->inverse, x, by);
        else
            e->kernels->solve(s->n, s->positive, s->A, by);
    }
    qdot_lanes_change(e->lanes, k, e->by);
}

static void
begin_member_series(const double *t, const double *y, const double *unit, void *user)
{
    qdot_ensemble_series *e = user;
    const qdot_plan *p = e->plan;
    const size_t n = e->n, row = e->stride * L;
    double *numbers = e->t + row;

    memcpy(e->unit, unit, sizeof e->unit);
    for (size_t i = 0; i < e->numbers; i++)
        memcpy(numbers + i * row, y + (2 * n + i) * L, L * sizeof *y);
    for (size_t c = 0; c < p->n_kept; c++)
        memcpy(numbers + (e->numbers + c) * row, y + (n + p->kept[c]) * L, L * sizeof *y);
    for (size_t i = 0; i < n; i++) {
        memcpy(e->q + i * row, y + i * L, L * sizeof *y);
        memcpy(e->v + i * row, y + (n + i) * L, L * sizeof *y);
        for (size_t l = 0; l < L; l++)
            e->q[i * row + L + l] = unit[l] * y[(n + i) * L + l];
    }
    memcpy(e->t, t, L * sizeof *t);
    memcpy(e->t + L, unit, L * sizeof *unit);
    qdot_lanes_set_unit(e->lanes, unit);
    qdot_lanes_draw(e->lanes, t);
    if (e->out)
        evaluate_mass_tape(e, t, y);
    for (int k = qdot_motion_first(e->motion); k <= 0; k++)
        compute_order(e, k);
}

static void
extend_member_series(int p, void *user)
{
    qdot_ensemble_series *e = user;

    for (size_t b = 0; b < e->blocks; b++)
        if (!is_pair_of_unknowns(e->solvers + b))
            e->kernels->invert(e->solvers[b].n, e->solvers[b].positive, e->solvers[b].A,
                               e->solvers[b].inverse);
    if (e->code && p == qdot_lanes_motion_orders(e->code) + 1) {
        for (size_t b = 0; b < e->blocks; b++)
            qdot_lanes_motion_set(e->code, b, e->solvers[b].inverse, e->solvers[b].n,
                                  NULL);
        qdot_lanes_motion_run(e->code, e->unit);
        return;
    }
    for (int k = 1; k < p; k++)
        compute_order(e, k);
}

static void
project_members(const double *t, double *y, double *carry, double *moved, void *user)
{
    qdot_constrained_lanes_project(((qdot_ensemble_series *)user)->held, t, y, carry, moved);
}

static void
find_safe_steps(int p, const double *s, const double *least, double *to, void *user)
{
    qdot_lanes_near(((qdot_ensemble_series *)user)->lanes, p - 2, s, least, to);
}

/* --- making the series --------------------------------------------------------------- */

static qdot_status
make_block_solver(qdot_ensemble_series *e, size_t b)
{
    const qdot_motion *m = e->motion;
    solver *s = e->solvers + b;
    const size_t first = m->blocks.at[b], n = m->blocks.at[b + 1] - first;

    *s = (solver){.first = first, .n = n};
    while (s->positive < n &&
           m->unknowns.at[m->solved.at[first + s->positive]].once != QDOT_NO_ROW)
        s->positive++;
    s->A = qdot_calloc(n * n * L, sizeof *s->A);
    s->inverse = qdot_calloc(n * n * L, sizeof *s->inverse);
    s->x = qdot_calloc(n * L, sizeof *s->x);
    return s->A && s->inverse && s->x ? QDOT_OK : QDOT_ENOMEM;
}

static int
choose_order(const qdot_plan *plan, double tol)
{
    const qdot_ode_series series = {.most = most_order - 4, .cost = plan->expansions};

    /* A few orders beyond the least cost hardly more, and where no pole is near, as of a stiff
     * spring, steps gain more by an order than its model has them gain. */
    return qdot_ode_taylor_order(&series, pow(tol, 1.15), false, 0);
}

static qdot_status
make_mass_tape(qdot_ensemble_series *e)
{
    const qdot_tape *masses = e->plan->residual->masses;

    e->in = qdot_calloc((2 * e->n + 1) * L, sizeof *e->in);
    e->out = qdot_calloc(qdot_tape_outputs(masses) * L + 1, sizeof *e->out);
    e->work = qdot_calloc(qdot_tape_work(masses) * L + 1, sizeof *e->work);
    if (!e->in || !e->out || !e->work)
        return QDOT_ENOMEM;
    return e->shaken ? qdot_tape_shake(masses, &e->shaken_masses) : QDOT_OK;
}

static qdot_status
make_ensemble_series(qdot_ensemble_series *e, bool shaken, double tol, int *order)
{
    qdot_lanes_rows rows;

    e->shaken = shaken;
    e->motion = uses_residual(e->plan) ? &e->plan->residual->motion : e->plan->motion;
    if (*order == 0)
        *order = choose_order(e->plan, tol);
    QDOT_TRY(qdot_lanes_of_motion(e->motion, shaken, *order, &e->lanes));
    if (uses_residual(e->plan))
        QDOT_TRY(make_mass_tape(e));
    if (e->plan->constraints)
        QDOT_TRY(qdot_constrained_lanes_new(e->plan, shaken, &e->held));
    e->stride = qdot_lanes_stride(e->lanes);
    e->q = qdot_lanes_input(e->lanes, 0);
    e->v = qdot_lanes_input(e->lanes, e->n);
    e->t = qdot_lanes_input(e->lanes, 2 * e->n);
    e->blocks = e->motion->blocks.n > 0 ? e->motion->blocks.n - 1 : 0;
    e->solvers = qdot_calloc(e->blocks + 1, sizeof *e->solvers);
    e->by = qdot_calloc(e->motion->solved.n * L + 1, sizeof *e->by);
    if (!e->solvers || !e->by)
        return QDOT_ENOMEM;
    for (size_t b = 0; b < e->blocks; b++)
        QDOT_TRY(make_block_solver(e, b));
    rows = qdot_lanes_get_rows(e->lanes);
    return qdot_lanes_motion_new(&rows, e->motion, *order - 1, 0, &e->code);
}

qdot_status
qdot_ensemble_series_new(const qdot_plan *plan, bool shaken, double tol, int *order,
                         qdot_ensemble_series **series)
{
    qdot_ensemble_series *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *series = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->plan = plan;
    e->numbers = plan->n_states;
    e->n = plan->n - e->numbers;
    e->kernels = qdot_batch_kernels_get();
    status = make_ensemble_series(e, shaken, tol, order);
    if (status != QDOT_OK) {
        qdot_ensemble_series_free(e);
        return status;
    }
    *series = e;
    return QDOT_OK;
}

void
qdot_ensemble_series_free(qdot_ensemble_series *e)
{
    if (!e)
        return;
    for (size_t b = 0; e->solvers && b < e->blocks; b++) {
        qdot_free(e->solvers[b].A);
        qdot_free(e->solvers[b].inverse);
        qdot_free(e->solvers[b].x);
    }
    qdot_lanes_motion_free(e->code);
    qdot_constrained_lanes_free(e->held);
    qdot_lanes_free(e->lanes);
    qdot_free(e->solvers);
    qdot_free(e->by);
    qdot_tape_free(e->shaken_masses);
    qdot_free(e->in);
    qdot_free(e->out);
    qdot_free(e->work);
    qdot_free(e);
}

static bool
is_momentum_kept(const qdot_plan *p, size_t i)
{
    for (size_t c = 0; c < p->n_kept; c++)
        if (p->kept[c] == i)
            return true;
    return false;
}

/* The number of components, at the end of a state, that stay constant: momenta and parameters. */
static size_t
count_constant_components(const qdot_ensemble_series *e)
{
    size_t k = 0;

    while (k < e->n && is_momentum_kept(e->plan, e->n - 1 - k))
        k++;
    return e->numbers + k;
}

qdot_ode_batch
qdot_ensemble_series_system(qdot_ensemble_series *e)
{
    return (qdot_ode_batch){.n = 2 * e->n + e->numbers,
                            .still = count_constant_components(e),
                            .checked = e->n,
                            .x = e->q,
                            .stride = e->stride,
                            .begin = begin_member_series,
                            .extend = extend_member_series,
                            .near = qdot_lanes_may_hide(e->lanes) ? find_safe_steps : NULL,
                            .project = e->held ? project_members : NULL,
                            .user = e};
}
