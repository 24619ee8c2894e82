/* blocks.c -- one solver a block of M. */
#include "sim/form/blocks.h"

#include <string.h>

#include "base/memory.h"
#include "num/cholesky.h"
#include "num/series.h"
#include "tape/shake.h"

qdot_status
qdot_blocks_singular(const qdot_plan *plan, const qdot_plan_block *block, size_t row)
{
    const char *name = plan->names[block->index[row]];

    if (row == 0)
        return qdot_fail(QDOT_ESINGULAR,
                         "the mass matrix is singular: no mass moves with %s", name);
    return qdot_fail(QDOT_ESINGULAR,
                     "the mass matrix is singular: %s moves no mass that %s%s not move already",
                     name, row == 1 ? plan->names[block->index[0]] : "the coordinates before it",
                     row == 1 ? " does" : " do");
}

qdot_status
qdot_blocks_factor(qdot_blocks *b, size_t k)
{
    const qdot_plan_block *block = b->plan->blocks + k;
    qdot_solver *s = b->at + k;
    size_t failed = 0;
    qdot_status status;

    b->factored++;
    status = b->plan->indefinite ? qdot_ldlt_factor(&s->ldlt, s->a, &failed)
                                 : qdot_cholesky_factor(s->a, block->n, NULL, &failed);
    return status == QDOT_OK ? QDOT_OK : qdot_blocks_singular(b->plan, block, failed);
}

void
qdot_blocks_solve(const qdot_blocks *b, size_t k)
{
    const qdot_solver *s = b->at + k;

    if (b->plan->indefinite)
        qdot_ldlt_solve(&s->ldlt, s->a, s->x);
    else
        qdot_cholesky_solve(s->a, b->plan->blocks[k].n, NULL, s->x);
}

qdot_status
qdot_blocks_prepare(qdot_blocks *b, size_t k)
{
    qdot_solver *s = b->at + k;
    size_t n = b->plan->blocks[k].n;

    if (b->plan->indefinite)
        return QDOT_OK;
    s->m = (n + 7) / 8 * 8;
    s->inverse = qdot_calloc(s->m * n, sizeof *s->inverse);
    s->lower = qdot_calloc(s->m * n, sizeof *s->lower);
    return s->inverse && s->lower ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_blocks_invert(qdot_blocks *b, size_t k)
{
    const qdot_series_kernels *kernels = qdot_series_kernels_get();
    const qdot_solver *s = b->at + k;
    size_t n = b->plan->blocks[k].n, m = s->m;

    if (!s->inverse)
        return;
    if (n == 2) { /* done before vectors are loaded */
        const double first = 1 / s->a[0], second = 1 / s->a[3];
        const double other = -s->a[2] * first * second;

        s->inverse[0] = first * first + other * other;
        s->inverse[1] = s->inverse[m] = other * second;
        s->inverse[m + 1] = second * second;
        return;
    }
    /* rows of L^-1, each of those before it; what is beyond their diagonals is 0 */
    for (size_t i = 0; i < n; i++) {
        const double *L = s->a + i * n;
        double *row = s->lower + i * m, scale = 1 / L[i];

        for (size_t j = 0; j < i; j++)
            s->x[j] = -L[j] * scale;
        kernels->multiply(m, i, s->lower, s->x, row);
        row[i] = scale;
    }
    /* of L^-T L^-1 row j: by column j of L^-1, which begins at its diagonal */
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j; i < n; i++)
            s->x[i - j] = s->lower[i * m + j];
        kernels->multiply(m, n - j, s->lower + j * m, s->x, s->inverse + j * m);
    }
}

void
qdot_blocks_apply(const qdot_blocks *b, size_t k)
{
    const qdot_solver *s = b->at + k;
    size_t n = b->plan->blocks[k].n;

    if (!s->inverse) {
        qdot_blocks_solve(b, k);
        return;
    }
    if (n == 2) { /* done before vectors are loaded */
        const double *w = s->inverse, u = s->x[0], v = s->x[1];

        s->x[0] = w[0] * u + w[s->m] * v;
        s->x[1] = w[1] * u + w[s->m + 1] * v;
        return;
    }
    qdot_series_kernels_get()->multiply(s->m, n, s->inverse, s->x, s->lower);
    memcpy(s->x, s->lower, n * sizeof *s->x);
}

const double *
qdot_blocks_unpack(const qdot_blocks *b, size_t k, const double *from)
{
    size_t n = b->plan->blocks[k].n;

    for (size_t i = 0; i < n; i++) {
        memcpy(b->at[k].a + i * n, from, (i + 1) * sizeof *from);
        from += i + 1;
    }
    return from;
}

static qdot_status
make_solver(qdot_blocks *b, size_t k, bool shaken)
{
    const qdot_plan_block *block = b->plan->blocks + k;
    qdot_solver *s = b->at + k;
    size_t n = block->n;

    s->a = qdot_calloc(n * n, sizeof *s->a);
    s->x = qdot_calloc(n, sizeof *s->x);
    if (!s->a || !s->x)
        return QDOT_ENOMEM;
    if (b->plan->indefinite)
        QDOT_TRY(qdot_ldlt_init(&s->ldlt, n));
    if (!block->constant)
        return QDOT_OK;
    memcpy(s->a, block->M, n * n * sizeof *s->a);
    for (size_t i = 0; shaken && i < n * n; i++)
        s->a[i] = qdot_shake_double(s->a[i], block->side[i]);
    return qdot_blocks_factor(b, k);
}

qdot_status
qdot_blocks_init(qdot_blocks *b, const qdot_plan *plan, bool shaken)
{
    *b = (qdot_blocks){.plan = plan};
    b->at = qdot_calloc(plan->structure.blocks + 1, sizeof *b->at);
    if (!b->at)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < plan->structure.blocks; k++)
        QDOT_TRY(make_solver(b, k, shaken));
    return QDOT_OK;
}

void
qdot_blocks_clear(qdot_blocks *b)
{
    for (size_t k = 0; b->at && k < b->plan->structure.blocks; k++) {
        qdot_free(b->at[k].a);
        qdot_free(b->at[k].x);
        qdot_free(b->at[k].inverse);
        qdot_free(b->at[k].lower);
        qdot_ldlt_clear(&b->at[k].ldlt);
    }
    qdot_free(b->at);
    *b = (qdot_blocks){0};
}
