/* motion-matrix.c -- the matrix K of the linear equations for accelerations and multipliers: entries, factors. */
#include "sim/form/motion-matrix.h"

#include <string.h>

#include "base/memory.h"
#include "tape/shake.h"

/* --- while a series is expanded ---------------------------------------------------------- */

static qdot_status
factor_varying_blocks(qdot_motion_matrix *K)
{
    if (K->saddle)
        return qdot_saddle_solver_factor(K->saddle);
    for (size_t k = 0; k < K->blocks; k++) {
        const qdot_solver *at = K->solvers.at + K->block[k];

        if (at->n > 1 && !at->constant)
            QDOT_TRY(qdot_blocks_factor(&K->solvers, K->block[k]));
    }
    return QDOT_OK;
}

/* Evaluate the matrix K (masses) of a d'Alembert residual at the state y. */
static void
evaluate_mass_matrix(qdot_motion_matrix *K, double t, const double *y)
{
    const double *out = K->out;

    memcpy(K->in, y, 2 * K->plan->n * sizeof *y);
    K->in[2 * K->plan->n] = t;
    qdot_tape_eval(K->shaken ? K->shaken : K->masses, K->in, K->out, K->work);
    for (size_t b = 0; b < K->solvers.n; b++)
        if (!K->solvers.at[b].constant)
            out = qdot_blocks_unpack(&K->solvers, b, out);
}

qdot_status
qdot_motion_matrix_begin(qdot_motion_matrix *K, double t, const double *y)
{
    K->refined = QDOT_SADDLE_REFINED;
    if (qdot_motion_matrix_is_mass(K)) {
        if (K->columns)
            qdot_mass_columns_evaluate(K->columns, t, y, K->solvers.at[0].a);
        else
            evaluate_mass_matrix(K, t, y);
        QDOT_TRY(factor_varying_blocks(K));
    }
    return K->saddle ? qdot_saddle_solver_look(K->saddle, t, y) : QDOT_OK;
}

qdot_status
qdot_motion_matrix_take_rows(qdot_motion_matrix *K)
{
    if (qdot_motion_matrix_is_mass(K))
        return QDOT_OK;
    for (size_t i = 0; i < K->n_entries; i++)
        *K->entries[i].to = *K->entries[i].from;
    return factor_varying_blocks(K);
}

void
qdot_motion_matrix_solve(qdot_motion_matrix *K, int k)
{
    double *by = K->by;

    if (K->saddle && k <= K->refined)
        qdot_saddle_solve_refined(&K->saddle->matrix);
    else if (K->saddle)
        qdot_saddle_apply(&K->saddle->matrix);
    for (size_t b = 0; b < K->blocks; b++) {
        const qdot_solver *at = K->solvers.at + K->block[b];

        if (at->n == 1)
            by[0] /= at->a[0];
        else if (k <= QDOT_BLOCKS_SOLVED)
            qdot_blocks_solve(&K->solvers, K->block[b], by);
        else
            qdot_blocks_apply(&K->solvers, K->block[b], by);
        by += at->n;
    }
}

void
qdot_motion_matrix_prepare(qdot_motion_matrix *K, int p)
{
    if (K->saddle) {
        K->refined = p < QDOT_SADDLE_LEAST_REFINED ? 0 : QDOT_SADDLE_REFINED;
        qdot_saddle_prepare(&K->saddle->matrix);
    }
    for (size_t b = 0; b < K->blocks; b++) {
        const qdot_solver *at = K->solvers.at + K->block[b];

        if (at->n > 1 && !at->constant)
            qdot_blocks_invert(&K->solvers, K->block[b]);
    }
}

void
qdot_motion_matrix_hand_over(const qdot_motion_matrix *K, qdot_taylor *taylor)
{
    for (size_t b = 0; b < K->blocks; b++) {
        const qdot_solver *at = K->solvers.at + K->block[b];
        const size_t n = at->n;
        double *to = qdot_taylor_matrices(taylor, b);

        for (size_t i = 0; i < n; i++) {
            memcpy(to + i * n, at->a + i * n, (i + 1) * sizeof *to);
            memcpy(to + (n + i) * n, at->inverse + i * at->m, n * sizeof *to);
        }
    }
}

void
qdot_motion_matrix_hand_to_lanes(const qdot_motion_matrix *K, qdot_lanes_motion *code)
{
    for (size_t b = 0; b < K->blocks; b++) {
        const qdot_solver *at = K->solvers.at + K->block[b];

        if (at->n > 1)
            qdot_lanes_motion_set(code, b, at->inverse, at->m, at->a);
        else
            qdot_lanes_motion_set(code, b, (double[]){1 / at->a[0]}, 1, NULL);
    }
}

size_t
qdot_motion_matrix_factored(const qdot_motion_matrix *K)
{
    return K->saddle ? K->saddle->matrix.factored : K->solvers.factored;
}

/* --- making the matrix ----------------------------------------------------------------- */

void
qdot_motion_matrix_clear(qdot_motion_matrix *K)
{
    qdot_tape_free(K->shaken);
    qdot_mass_columns_free(K->columns);
    qdot_blocks_clear(&K->solvers);
    qdot_free(K->block);
    qdot_free(K->entries);
    if (K->saddle)
        qdot_saddle_solver_clear(K->saddle);
    else
        qdot_free(K->by);
    qdot_free(K->saddle);
    qdot_free(K->in);
    qdot_free(K->out);
    qdot_free(K->work);
    *K = (qdot_motion_matrix){0};
}

/* Find the blocks of K for which equations are solved, and invert the constant ones. */
static qdot_status
make_block_solvers(qdot_motion_matrix *K, bool shaken)
{
    const qdot_motion *m = K->motion;

    QDOT_TRY(qdot_blocks_init(&K->solvers, K->plan, shaken));
    K->blocks = m->blocks.n > 0 ? m->blocks.n - 1 : 0;
    K->block = qdot_calloc(K->blocks + 1, sizeof *K->block);
    if (!K->block)
        return QDOT_ENOMEM;
    for (size_t b = 0, k = 0; b < K->blocks; b++, k++) {
        while (!qdot_motion_matrix_is_mass(K) && K->solvers.at[k].n == 1) /* skip single unknowns: each is given by its own row of the program */
            k++;
        K->block[b] = k;
        QDOT_TRY(qdot_blocks_prepare(&K->solvers, k));
        if (K->solvers.at[k].n > 1 && K->solvers.at[k].constant)
            qdot_blocks_invert(&K->solvers, k);
    }
    return QDOT_OK;
}

/* List the program rows from which the entries (lower triangles) of varying blocks are copied. */
static qdot_status
list_varying_entries(qdot_motion_matrix *K, qdot_taylor *taylor)
{
    const qdot_motion *m = K->motion;
    size_t k = 0;

    K->entries = qdot_calloc(m->entries.n + 1, sizeof *K->entries);
    if (!K->entries)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m->entries.n; i++) {
        const qdot_motion_entry *x = m->entries.at + i;
        const uint32_t row = x->i > x->j ? x->i : x->j,
                       column = x->i > x->j ? x->j : x->i;
        const qdot_solver *at;

        while (x->i >= m->blocks.at[k + 1])
            k++;
        at = K->solvers.at + K->block[k];
        if (!at->constant)
            K->entries[K->n_entries++] = (qdot_motion_matrix_entry){at->a + (row - m->blocks.at[k]) * at->n +
                                                     (column - m->blocks.at[k]),
                                                 qdot_taylor_series(taylor, x->at)};
    }
    return QDOT_OK;
}

static qdot_status
make_constraint_solver(qdot_motion_matrix *K, qdot_taylor *taylor)
{
    K->saddle = qdot_calloc(1, sizeof *K->saddle);
    if (!K->saddle)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_saddle_solver_init(K->saddle, K->plan, taylor));
    K->by = K->saddle->matrix.x;
    return QDOT_OK;
}

static qdot_status
make_residual_mass_tape(qdot_motion_matrix *K, bool shaken)
{
    if (shaken)
        QDOT_TRY(qdot_tape_shake(K->masses, &K->shaken));
    K->in = qdot_calloc(2 * K->plan->n + 1, sizeof *K->in);
    K->out = qdot_calloc(qdot_tape_outputs(K->masses) + 1, sizeof *K->out);
    K->work = qdot_calloc(qdot_tape_work(K->masses) + 1, sizeof *K->work);
    return K->in && K->out && K->work ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
make_blocks(qdot_motion_matrix *K, qdot_taylor *taylor, bool shaken)
{
    K->by = qdot_calloc(K->motion->solved.n + 1, sizeof *K->by);
    if (!K->by)
        return QDOT_ENOMEM;
    if (K->plan->residual && K->motion == &K->plan->residual->motion && K->plan->residual->adjoint)
        QDOT_TRY(qdot_mass_columns_new(K->plan->residual, K->plan->n, shaken, &K->columns));
    QDOT_TRY(make_block_solvers(K, shaken));
    if (K->columns)
        return QDOT_OK;
    return K->masses ? make_residual_mass_tape(K, shaken) : list_varying_entries(K, taylor);
}

qdot_status
qdot_motion_matrix_init(qdot_motion_matrix *K, const qdot_plan *plan, const qdot_motion *motion,
                        const qdot_tape *masses, qdot_taylor *taylor, bool shaken)
{
    const bool constrained = plan->constraints && motion == &plan->constraints->motion;

    *K = (qdot_motion_matrix){.plan = plan, .motion = motion, .masses = masses};
    return constrained ? make_constraint_solver(K, taylor) : make_blocks(K, taylor, shaken);
}
