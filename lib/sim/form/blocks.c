/* blocks.c -- factors the blocks of M and solves with them. */
#include "sim/form/blocks.h"

#include <string.h>

#include "base/memory.h"
#include "num/bordered.h"
#include "num/cholesky.h"
#include "num/series.h"
#include "sim/model/constraints.h"
#include "tape/shake.h"

/* Squared sine below which a constraint's gradient counts as dependent on those before it. */
static const double least_sine = 0.1;

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

/* Invert the matrix [M A^T; A 0] of the equations with constraints; systems are solved by its inverse. */
static qdot_status
invert_constrained_matrix(const qdot_blocks *b, const qdot_solver *s)
{
    double(*K)[QDOT_BORDERED_MOST] = (double(*)[QDOT_BORDERED_MOST])s->inverse;
    const size_t n = b->plan->n, m = s->n - n;

    memset(K, 0, QDOT_BORDERED_MOST * sizeof *K);
    for (size_t i = 0; i < s->n; i++)
        for (size_t j = 0; j <= i; j++)
            K[i][j] = K[j][i] = s->a[i * s->n + j];
    if (b->diagonal ? qdot_bordered_invert_diagonal(n, m, K, least_sine)
                    : qdot_bordered_invert(n, m, K, least_sine))
        return QDOT_OK;
    return qdot_fail(QDOT_EDOMAIN, "constraints depend on each other");
}

qdot_status
qdot_blocks_factor(qdot_blocks *b, size_t k)
{
    const qdot_plan *p = b->plan;
    qdot_solver *s = b->at + k;
    size_t failed = 0;
    qdot_status status;

    b->factored++;
    if (p->constraints)
        return invert_constrained_matrix(b, s);
    status = p->indefinite ? qdot_ldlt_factor(&s->ldlt, s->a, &failed)
                           : qdot_cholesky_factor(s->a, s->n, NULL, &failed);
    return status == QDOT_OK ? QDOT_OK : qdot_blocks_singular(p, p->blocks + k, failed);
}

void
qdot_blocks_solve(const qdot_blocks *b, size_t k, double *x)
{
    const qdot_solver *s = b->at + k;

    if (b->plan->constraints)
        qdot_blocks_apply(b, k, x);
    else if (b->plan->indefinite)
        qdot_ldlt_solve(&s->ldlt, s->a, x);
    else
        qdot_cholesky_solve(s->a, s->n, NULL, x);
}

qdot_status
qdot_blocks_prepare(qdot_blocks *b, size_t k)
{
    qdot_solver *s = b->at + k;
    size_t n = s->n;

    if (b->plan->indefinite || s->inverse)
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
    size_t n = s->n, m = s->m;

    if (!s->inverse || b->plan->constraints)
        return;
    if (n == 2) { /* 2 x 2 matrix: closed form, as vector code would start slowly */
        const double first = 1 / s->a[0], second = 1 / s->a[3];
        const double other = -s->a[2] * first * second;

        s->inverse[0] = first * first + other * other;
        s->inverse[1] = s->inverse[m] = other * second;
        s->inverse[m + 1] = second * second;
        return;
    }
    /* compute the rows of L^-1 from the earlier ones; entries beyond the diagonal are 0 */
    for (size_t i = 0; i < n; i++) {
        const double *L = s->a + i * n;
        double *row = s->lower + i * m, scale = 1 / L[i];

        for (size_t j = 0; j < i; j++)
            s->x[j] = -L[j] * scale;
        kernels->multiply(m, i, s->lower, s->x, row);
        row[i] = scale;
    }
    /* row j of L^-T L^-1 from column j of L^-1, which is 0 above the diagonal */
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j; i < n; i++)
            s->x[i - j] = s->lower[i * m + j];
        kernels->multiply(m, n - j, s->lower + j * m, s->x, s->inverse + j * m);
    }
}

void
qdot_blocks_apply(const qdot_blocks *b, size_t k, double *x)
{
    const qdot_solver *s = b->at + k;
    size_t n = b->at[k].n;

    if (!s->inverse) {
        qdot_blocks_solve(b, k, x);
        return;
    }
    if (n == 2) { /* 2 x 2 matrix: closed form, as vector code would start slowly */
        const double *w = s->inverse, u = x[0], v = x[1];

        x[0] = w[0] * u + w[s->m] * v;
        x[1] = w[1] * u + w[s->m + 1] * v;
        return;
    }
    qdot_series_kernels_get()->multiply(s->m, n, s->inverse, x, s->lower);
    memcpy(x, s->lower, n * sizeof *s->x);
}

const double *
qdot_blocks_unpack(const qdot_blocks *b, size_t k, const double *from)
{
    size_t n = b->at[k].n;

    for (size_t i = 0; i < n; i++) {
        memcpy(b->at[k].a + i * n, from, (i + 1) * sizeof *from);
        from += i + 1;
    }
    return from;
}

static qdot_status
prepare_constrained_solver(qdot_blocks *b, qdot_solver *s)
{
    const qdot_constraints *c = b->plan->constraints;

    if (s->n > QDOT_BORDERED_MOST)
        return qdot_fail(QDOT_EINVAL, "%zu unknowns are too many for one inverse", s->n);
    b->diagonal = true;
    for (size_t k = 0; k < c->n_masses; k++)
        b->diagonal = b->diagonal && c->masses[k].row == c->masses[k].column;
    s->m = QDOT_BORDERED_MOST;
    s->inverse = qdot_calloc(s->m * s->m, sizeof *s->inverse);
    s->lower = qdot_calloc(s->m, sizeof *s->lower);
    return s->inverse && s->lower ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
make_solver(qdot_blocks *b, size_t k, bool shaken)
{
    const qdot_plan_block *block = b->plan->blocks + k;
    qdot_solver *s = b->at + k;
    size_t n = s->n;

    s->a = qdot_calloc(n * n, sizeof *s->a);
    s->x = qdot_calloc(n, sizeof *s->x);
    if (!s->a || !s->x)
        return QDOT_ENOMEM;
    if (b->plan->constraints)
        return prepare_constrained_solver(b, s);
    if (b->plan->indefinite)
        QDOT_TRY(qdot_ldlt_init(&s->ldlt, n));
    if (!s->constant)
        return QDOT_OK;
    memcpy(s->a, block->M, n * n * sizeof *s->a);
    for (size_t i = 0; shaken && i < n * n; i++)
        s->a[i] = qdot_shake_double(s->a[i], block->side[i]);
    return qdot_blocks_factor(b, k);
}

qdot_status
qdot_blocks_init(qdot_blocks *b, const qdot_plan *plan, bool shaken)
{
    const qdot_constraints *c = plan->constraints;

    *b = (qdot_blocks){.plan = plan, .n = c ? 1 : plan->structure.blocks};
    b->at = qdot_calloc(b->n + 1, sizeof *b->at);
    if (!b->at)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < b->n; k++) {
        b->at[k].n = c ? plan->n + c->m : plan->blocks[k].n;
        b->at[k].constant = !c && plan->blocks[k].constant;
        QDOT_TRY(make_solver(b, k, shaken));
    }
    return QDOT_OK;
}

void
qdot_blocks_clear(qdot_blocks *b)
{
    for (size_t k = 0; b->at && k < b->n; k++) {
        qdot_free(b->at[k].a);
        qdot_free(b->at[k].x);
        qdot_free(b->at[k].inverse);
        qdot_free(b->at[k].lower);
        qdot_ldlt_clear(&b->at[k].ldlt);
    }
    qdot_free(b->at);
    *b = (qdot_blocks){0};
}
