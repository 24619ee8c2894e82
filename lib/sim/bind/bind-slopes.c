/* bind-slopes.c -- derivatives of the equations of motion: the Jacobian of q'', and M q'' = f for implicit methods. */
#include "sim/bind/bind-state.h"

#include "base/memory.h"
#include "tape/derivative.h"

/* Whether the outputs of block k are q'' itself: it has one coordinate, or its constant M was
 * factored before. */
static bool
is_solved_for_accelerations(const qdot_plan_block *block)
{
    return block->n == 1 || block->constant;
}

/* The index of the first tape output after those of block k, which start at index `row`. */
static size_t
output_after_block(const qdot_plan_block *block, size_t row)
{
    return row + block->n + (is_solved_for_accelerations(block) ? 0 : block->n * (block->n + 1) / 2);
}

/* For block k, whose outputs begin with `row`: of its coordinates
 *
 *     df/dz - dM/dz q'',   z the column of slopes,
 *
 * into its x; times M^-1 if that is constant. */
static void
block_jacobian_column(const qdot_bind *b, size_t k, size_t row, size_t column)
{
    const qdot_plan_block *block = b->plan->blocks + k;
    const size_t columns = 2 * b->plan->n + 1;
    const double *slope = b->slopes + row * columns + column;
    const double *a = b->in + columns; /* the accelerations q'', inputs of the tape */
    double *x = b->blocks.at[k].x;

    for (size_t i = 0; i < block->n; i++, slope += columns)
        x[i] = *slope;
    if (block->n == 1)
        return; /* with one coordinate nothing has to be solved: the tape's output is q'' itself */
    for (size_t i = 0; i < block->n && !block->constant; i++)
        for (size_t j = 0; j <= i; j++, slope += columns) {
            x[i] -= *slope * a[block->index[j]];
            if (j < i)
                x[j] -= *slope * a[block->index[i]];
        }
    if (block->constant)
        qdot_blocks_solve(&b->blocks, k, x);
}

qdot_status
qdot_bind_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    qdot_bind *b = user;
    const qdot_plan *p = b->plan;
    const size_t n = p->n, columns = 2 * n + 1;
    size_t row = 0;

    if (b->held)
        return qdot_constrained_jacobian(b->held, t, y, dfdy, dfdt);
    qdot_bind_load(b, t, y);
    QDOT_TRY(qdot_bind_accelerate(b, b->in + columns));
    qdot_derivative_eval(qdot_bind_equations(b), b->in, 0, columns, b->out, b->slopes,
                         b->slopes_work);
    memset(dfdy, 0, 4 * n * n * sizeof *dfdy);
    for (size_t i = 0; i < n; i++) {
        dfdy[i * 2 * n + n + i] = 1;
        dfdt[i] = 0;
    }
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;

        for (size_t j = 0; j < columns; j++) {
            block_jacobian_column(b, k, row, j);
            if (!is_solved_for_accelerations(block)) /* solve M dq''/dz = column, z being a coordinate, velocity or t */
                qdot_blocks_solve(&b->blocks, k, b->blocks.at[k].x);
            for (size_t i = 0; i < block->n; i++) {
                size_t at = n + block->index[i];

                *(j < 2 * n ? &dfdy[at * 2 * n + j] : &dfdt[at]) = b->blocks.at[k].x[i];
            }
        }
        row = output_after_block(block, row);
    }
    return QDOT_OK;
}

/* --- the form with M: f - M a, or q'' - a where a block is solved ---------------------------- */

static qdot_status
constrained_residual(double t, const double *y, const double *a, const double *z, double *r, void *user)
{
    return qdot_constrained_implicit(((qdot_bind *)user)->held, t, y, a, z, r);
}

static qdot_status
evaluate_residual(double t, const double *y, const double *a, const double *z, double *r, void *user)
{
    qdot_bind *b = user;
    const qdot_plan *p = b->plan;
    const double *out = b->out;

    (void)z;
    qdot_bind_load(b, t, y);
    qdot_tape_eval(qdot_bind_equations(b), b->in, b->out, b->work);
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;
        double *x = b->blocks.at[k].x;

        for (size_t i = 0; i < block->n; i++)
            x[i] = *out++;
        if (block->n > 1 && block->constant)
            qdot_blocks_solve(&b->blocks, k, x);
        for (size_t i = 0; i < block->n; i++)
            r[block->index[i]] = is_solved_for_accelerations(block) ? x[i] - a[block->index[i]] : x[i];
        for (size_t i = 0; i < block->n && !is_solved_for_accelerations(block); i++)
            for (size_t j = 0; j <= i; j++, out++) {
                r[block->index[i]] -= *out * a[block->index[j]];
                if (j < i)
                    r[block->index[j]] -= *out * a[block->index[i]];
            }
    }
    return QDOT_OK;
}

static qdot_status
constrained_slopes(double t, const double *y, const double *a, double *z, double *dq, double *dv,
                   double *M, void *user)
{
    (void)a;
    return qdot_constrained_implicit_slopes(((qdot_bind *)user)->held, t, y, z, dq, dv, M);
}

/* Copy the mass matrix of block k of the equations from the tape's outputs (from `out` on) into M. */
static void
copy_block_mass(const qdot_plan *p, const qdot_plan_block *block, const double *out, double *M)
{
    for (size_t i = 0; i < block->n; i++)
        for (size_t j = 0; j <= i; j++) {
            const size_t row = block->index[i], column = block->index[j];

            M[row * p->n + column] = M[column * p->n + row] =
                is_solved_for_accelerations(block) ? (double)(i == j) : *out++;
        }
}

static qdot_status
evaluate_derivatives(double t, const double *y, const double *a, double *z, double *dq, double *dv, double *M,
                     void *user)
{
    qdot_bind *b = user;
    const qdot_plan *p = b->plan;
    const size_t n = p->n, columns = 2 * n + 1;
    size_t row = 0;

    (void)z;
    qdot_bind_load(b, t, y);
    memcpy(b->in + columns, a, n * sizeof *a);
    qdot_derivative_eval(qdot_bind_equations(b), b->in, 0, columns, b->out, b->slopes,
                         b->slopes_work);
    memset(M, 0, n * n * sizeof *M);
    memset(dq, 0, n * n * sizeof *dq);
    memset(dv, 0, n * n * sizeof *dv);
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;

        copy_block_mass(p, block, b->out + row + block->n, M);
        for (size_t j = 0; j < 2 * n; j++) {
            block_jacobian_column(b, k, row, j);
            for (size_t i = 0; i < block->n; i++)
                (j < n ? dq + j : dv + j - n)[block->index[i] * n] = b->blocks.at[k].x[i];
        }
        row = output_after_block(block, row);
    }
    return QDOT_OK;
}

/* --- allocating work space -------------------------------------------------------------- */

qdot_status
qdot_bind_make_slopes(qdot_bind *b)
{
    const qdot_plan *p = b->plan;

    if (!qdot_plan_needs_jacobian(p))
        return QDOT_OK;
    if (p->constraints) {
        b->mass_form = (qdot_ode_mass_form){p->n, p->constraints->m, constrained_residual, constrained_slopes, b};
        return QDOT_OK;
    }
    b->mass_form = (qdot_ode_mass_form){p->n, 0, evaluate_residual, evaluate_derivatives, b};
    b->slopes_work =
        qdot_malloc((qdot_derivative_work(p->tape) + 1) * sizeof *b->slopes_work);
    b->slopes = qdot_malloc((qdot_tape_outputs(p->tape) * (2 * p->n + 1) + 1) *
                            sizeof *b->slopes);
    return b->slopes && b->slopes_work ? QDOT_OK : QDOT_ENOMEM;
}
