/* leading.c -- corrects the first orders of a series in two doubles, by the residual of the
 * solution in doubles. */
#include "sim/form/leading.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/two.h"
#include "sim/form/blocks.h"
#include "sim/form/residual.h"

/* The largest number of corrections of one order; a correction smaller than `enough` is the last. */
enum { most_corrections = 4 };
static const double enough = 0x1p-36;

_Static_assert((int)QDOT_ODE_LEADING_MOST <= (int)QDOT_TWO_MOST, "orders that are asked for are there");

struct qdot_leading {
    const qdot_plan *plan;
    const qdot_ode_series *series;
    const qdot_motion *motion; /* series program of d'Alembert's residual if that form is used, else of M q'' = f */
    qdot_tape_two *two;
    qdot_ode_leading leading;
    qdot_blocks solvers;
    qdot_two *q, *v, *t; /* Taylor coefficients of q, q', t; rows are `stride` apart */
    size_t stride;
    double unit;
    double *newest, *by;     /* [solved] first guess of the accelerations' coefficients; its error */
    double *in, *out, *work; /* inputs, outputs and scratch of the tape of M (plans with a residual) */
    const double *hi, *lo;   /* [n_kept] conserved momenta, hi + lo; borrowed */
};

/* --- the mass matrix ----------------------------------------------------------------- */

/* The k-th block among those blocks of the plan that are solved for; the search starts at index *b. */
static const qdot_plan_block *
find_solved_block(const qdot_leading *l, size_t *b)
{
    while (!l->plan->residual && l->plan->blocks[*b].n == 1)
        ++*b;
    return l->plan->blocks + *b;
}

/* Fill block k of M with its entries, which rows of the series program have computed. */
static void
copy_block_entries(const qdot_leading *l, size_t k, size_t b)
{
    const qdot_motion *m = l->motion;
    const uint32_t first = m->blocks.at[k], end = m->blocks.at[k + 1], n = end - first;
    double *to = l->solvers.at[b].a;

    memset(to, 0, n * n * sizeof *to);
    for (size_t e = 0; e < m->entries.n; e++) {
        const qdot_motion_entry *x = m->entries.at + e;

        if (x->i >= first && x->i < end)
            to[(x->i - first) * n + x->j - first] = qdot_tape_two_row(l->two, x->at)[0].hi;
    }
}

static qdot_status
factor_blocks(qdot_leading *l, const double *masses)
{
    size_t b = 0;

    for (size_t k = 0; k + 1 < l->motion->blocks.n; k++, b++) {
        const qdot_plan_block *block = find_solved_block(l, &b);

        if (block->constant)
            continue;
        if (masses)
            masses = qdot_blocks_unpack(&l->solvers, b, masses);
        else
            copy_block_entries(l, k, b);
        if (block->n > 1)
            QDOT_TRY(qdot_blocks_factor(&l->solvers, b));
    }
    return QDOT_OK;
}

/* For d'Alembert's residual: evaluate the tape of M at a state and factor M. */
static qdot_status
factor_masses_of_residual(qdot_leading *l, const qdot_ode_place *at)
{
    const size_t n = l->plan->n;

    memcpy(l->in, at->y, 2 * n * sizeof *l->in);
    l->in[2 * n] = at->t;
    qdot_tape_eval(l->plan->residual->masses, l->in, l->out, l->work);
    return factor_blocks(l, l->out);
}

/* --- one order of the series --------------------------------------------------------- */

/* Solve for the correction of the accelerations' coefficients of order k. Returns its relative size. */
static double
correct_accelerations(qdot_leading *l, int k)
{
    const qdot_motion *m = l->motion;
    double most = 0, size = 0;
    size_t b = 0;

    for (size_t at = 0; at + 1 < m->blocks.n; at++, b++) {
        const uint32_t first = m->blocks.at[at];
        const size_t n = find_solved_block(l, &b)->n;
        double *x = l->by + first;

        for (size_t i = 0; i < n; i++)
            x[i] = -qdot_tape_two_row(l->two, m->equations.at[first + i])[k].hi;
        if (n == 1)
            x[0] /= l->solvers.at[b].a[0];
        else
            qdot_blocks_solve(&l->solvers, b, x);
    }
    for (size_t i = 0; i < m->solved.n; i++) {
        most = fmax(most, fabs(l->by[i]));
        size = fmax(size, fabs(l->newest[i]));
    }
    return most / size;
}

/* Set the accelerations' coefficients of order k, in doubles, from those of the velocities. */
static void
guess_accelerations(qdot_leading *l, int k)
{
    const qdot_motion *m = l->motion;

    for (size_t i = 0; i < m->solved.n; i++) {
        const size_t v = m->unknowns.at[m->solved.at[i]].once;

        l->newest[i] = l->series->x[v * l->series->stride + (size_t)k + 1] * (k + 1) / l->unit;
    }
}

static qdot_status
begin_double_double_series(const qdot_ode_place *at, double unit, void *user)
{
    qdot_leading *l = user;
    const size_t n = l->plan->n;

    l->unit = unit;
    qdot_tape_two_set_unit(l->two, unit);
    for (size_t i = 0; i < 2 * n; i++)
        l->q[i * l->stride] = qdot_two_of(at->y[i], at->carry ? at->carry[i] : 0);
    for (size_t i = 0; i < n; i++)
        l->q[i * l->stride + 1] = qdot_two_scale(l->v[i * l->stride], unit);
    l->t[0] = qdot_two_of(at->t, at->t_low);
    l->t[1] = (qdot_two){unit, 0};
    for (size_t c = 0; c < l->plan->n_kept; c++)
        l->t[(c + 1) * l->stride] = (qdot_two){l->hi[c], l->lo[c]};
    for (int k = qdot_motion_first(l->motion); k < 0; k++)
        qdot_tape_two_stage(l->two, k, NULL);
    return l->plan->residual ? factor_masses_of_residual(l, at) : QDOT_OK;
}

/* Compute coefficients k of q and v from order k - 1 of the accelerations. */
static qdot_status
compute_next_order(int k, void *user)
{
    qdot_leading *l = user;
    double nothing = 0; /* sum of 0 times each value: 0 if all values are finite, else NaN */

    guess_accelerations(l, k - 1);
    qdot_tape_two_stage(l->two, k - 1, l->newest);
    if (k == 1 && !l->plan->residual)
        QDOT_TRY(factor_blocks(l, NULL));
    for (int tries = 0; tries < most_corrections && l->motion->solved.n > 0; tries++) {
        const double share = correct_accelerations(l, k - 1);

        qdot_tape_two_change(l->two, k - 1, l->by);
        if (!(share > enough))
            break;
    }
    for (size_t i = 0; i < 2 * l->plan->n; i++) {
        const qdot_two x = l->q[i * l->stride + (size_t)k];

        nothing += 0 * (x.hi + x.lo);
    }
    return nothing == 0 ? QDOT_OK
                        : qdot_fail(QDOT_EDOMAIN,
                                    "the first orders of the motion are not finite");
}

/* --- making the series --------------------------------------------------------------- */

static qdot_status
make_mass_tape(qdot_leading *l)
{
    const qdot_tape *masses = l->plan->residual->masses;

    l->in = qdot_calloc(qdot_tape_inputs(masses) + 1, sizeof *l->in);
    l->out = qdot_calloc(qdot_tape_outputs(masses) + 1, sizeof *l->out);
    l->work = qdot_calloc(qdot_tape_work(masses) + 1, sizeof *l->work);
    return l->in && l->out && l->work ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
make_leading_series(qdot_leading *l)
{
    const size_t n = l->plan->n;

    if (l->plan->residual) {
        l->motion = &l->plan->residual->motion;
        QDOT_TRY(make_mass_tape(l));
    } else {
        l->motion = l->plan->motion;
    }
    QDOT_TRY(qdot_tape_two_of_motion(l->motion, &l->two));
    QDOT_TRY(qdot_blocks_init(&l->solvers, l->plan, false));
    l->stride = qdot_tape_two_stride(l->two);
    l->q = qdot_tape_two_input(l->two, 0);
    l->v = qdot_tape_two_input(l->two, n);
    l->t = qdot_tape_two_input(l->two, 2 * n);
    l->newest = qdot_calloc(l->motion->solved.n + 1, sizeof *l->newest);
    l->by = qdot_calloc(l->motion->solved.n + 1, sizeof *l->by);
    if (!l->newest || !l->by)
        return QDOT_ENOMEM;
    l->leading =
        (qdot_ode_leading){.x = l->q, .stride = l->stride, .begin = begin_double_double_series, .next = compute_next_order, .user = l};
    return QDOT_OK;
}

qdot_status
qdot_leading_new(const qdot_plan *plan, const qdot_ode_series *series, qdot_leading **out)
{
    qdot_leading *l = qdot_calloc(1, sizeof *l);
    qdot_status status;

    *out = NULL;
    if (!l)
        return QDOT_ENOMEM;
    l->plan = plan;
    l->series = series;
    status = make_leading_series(l);
    if (status != QDOT_OK) {
        qdot_leading_free(l);
        return status;
    }
    *out = l;
    return QDOT_OK;
}

void
qdot_leading_free(qdot_leading *l)
{
    if (!l)
        return;
    qdot_blocks_clear(&l->solvers);
    qdot_tape_two_free(l->two);
    qdot_free(l->newest);
    qdot_free(l->by);
    qdot_free(l->in);
    qdot_free(l->out);
    qdot_free(l->work);
    qdot_free(l);
}

void
qdot_leading_keep(qdot_leading *l, const double *hi, const double *lo)
{
    l->hi = hi;
    l->lo = lo;
}

const qdot_ode_leading *
qdot_leading_get(const qdot_leading *l)
{
    return &l->leading;
}
