/* taylor-unknowns.c -- rows that a program solves for at every order. */
#include "base/memory.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

static double *
spare_row(qdot_taylor *t)
{
    return t->coefficients + t->spare++ * t->stride;
}

qdot_status
qdot_taylor_solve_entries(qdot_taylor *t, const qdot_taylor_equations *equations,
                          double *const **a, double **matrices)
{
    const size_t n = equations->n;
    size_t capacity = t->n_blocks;
    qdot_taylor_block *b;

    if (t->spare + 2 * n > t->rows)
        return qdot_fail(QDOT_EINVAL, "there is no room for %zu unknowns", n);
    QDOT_TRY(qdot_grow(&t->blocks, &capacity, capacity + 1, sizeof *t->blocks));
    b = t->blocks + t->n_blocks++;
    *b = (qdot_taylor_block){.n = n, .solved = equations->solved};
    b->f = qdot_calloc(n, sizeof *b->f);
    b->a = qdot_calloc(2 * n, sizeof *b->a);
    b->couplings = qdot_calloc(equations->count + 1, sizeof *b->couplings);
    b->matrices = qdot_calloc(2 * n * n, sizeof *b->matrices);
    if (!b->f || !b->a || !b->couplings || !b->matrices)
        return QDOT_ENOMEM;
    b->r = b->a + n;
    for (size_t i = 0; i < 2 * n; i++)
        b->a[i] = spare_row(t);
    for (size_t i = 0; i < n; i++)
        b->f[i] = t->output[equations->f[i]];
    for (size_t k = 0; k < equations->count; k++) {
        const qdot_taylor_entry *e = equations->entries + k;

        if (!t->constant[e->output])
            b->couplings[b->n_couplings++] =
                (qdot_taylor_coupling){(uint32_t)e->i, t->output[e->output], b->a[e->j]};
    }
    *a = b->a;
    *matrices = b->matrices;
    return QDOT_OK;
}

/* Rows of the lower triangle, and of what it stands for above. */
static void
whole_matrix(size_t n, const size_t *M, qdot_taylor_entry *to)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            const size_t low = i < j ? i : j, high = i < j ? j : i;

            *to++ = (qdot_taylor_entry){i, j, M[high * (high + 1) / 2 + low]};
        }
}

qdot_status
qdot_taylor_solve(qdot_taylor *t, size_t n, const size_t *f, const size_t *M, int solved,
                  double *const **a, double **matrices)
{
    qdot_taylor_entry *entries = qdot_calloc(n * n, sizeof *entries);
    qdot_status status;

    if (!entries)
        return QDOT_ENOMEM;
    if (M)
        whole_matrix(n, M, entries);
    status = qdot_taylor_solve_entries(
        t, &(qdot_taylor_equations){n, f, M ? n * n : 0, entries, solved}, a, matrices);
    qdot_free(entries);
    return status;
}
