/* taylor-unknowns.c -- unknowns of explicit equations: couplings of a motion, block by block. */
#include <string.h>

#include "base/memory.h"
#include "series/taylor-motion.h"
#include "series/taylor-steps.h"

/* Empty, for n unknowns with up to `count` couplings. */
static qdot_status
add_block(qdot_taylor *t, size_t n, size_t count, int solved, qdot_taylor_block **block)
{
    size_t capacity = t->n_blocks;
    qdot_taylor_block *b;

    QDOT_TRY(qdot_grow(&t->blocks, &capacity, capacity + 1, sizeof *t->blocks));
    *block = b = t->blocks + t->n_blocks++;
    *b = (qdot_taylor_block){.n = n, .solved = solved};
    b->f = qdot_calloc(n, sizeof *b->f);
    b->a = qdot_calloc(2 * n, sizeof *b->a);
    b->couplings = qdot_calloc(count + 1, sizeof *b->couplings);
    b->matrices = qdot_calloc(2 * n * n, sizeof *b->matrices);
    if (!b->f || !b->a || !b->couplings || !b->matrices)
        return QDOT_ENOMEM;
    b->r = b->a + n;
    return QDOT_OK;
}

/* Entry (i, j) of K times unknown j, if it moves. */
static void
count_coupling(const qdot_motion *m, const qdot_motion_entry *e, size_t *rows)
{
    if (m->program.rows.at[e->at].still)
        return;
    rows[e->i]++;
    if (e->i != e->j)
        rows[e->j]++;
}

static void
couple(qdot_taylor *t, qdot_taylor_block *b, const qdot_motion_entry *e, size_t *next)
{
    const qdot_motion *m = t->motion;
    const double *M = qdot_taylor_place(t, e->at);

    if (m->program.rows.at[e->at].still)
        return;
    b->couplings[next[e->i]++] = (qdot_taylor_coupling){e->i, M, b->a[e->j]};
    if (e->i != e->j)
        b->couplings[next[e->j]++] = (qdot_taylor_coupling){e->j, M, b->a[e->i]};
}

/* Entries of a motion are those of its first block, then of the next: *entry is where those of
 * block k begin, then where they end. rows [solved + 1] is scratch. */
static qdot_status
solve_block(qdot_taylor *t, size_t k, int solved, size_t *entry, size_t *rows)
{
    const qdot_motion *m = t->motion;
    const uint32_t first = m->blocks.at[k], end = m->blocks.at[k + 1];
    const size_t n = end - first, from = *entry;
    size_t count = 0;
    qdot_taylor_block *b;

    memset(rows, 0, (m->solved.n + 1) * sizeof *rows);
    while (*entry < m->entries.n && m->entries.at[*entry].i < end) {
        qdot_motion_entry e = m->entries.at[(*entry)++];

        e.i -= first;
        e.j -= first;
        count_coupling(m, &e, rows);
    }
    for (size_t i = 0; i < n; i++) { /* how many become where they begin */
        const size_t of_row = rows[i];

        rows[i] = count;
        count += of_row;
    }
    QDOT_TRY(add_block(t, n, count, solved, &b));
    b->n_couplings = count;
    for (size_t i = 0; i < n; i++) {
        b->f[i] = qdot_taylor_place(t, m->right.at[first + i]);
        b->a[i] = qdot_taylor_place(t, m->unknowns.at[m->solved.at[first + i]].row);
        b->r[i] = t->coefficients + t->spare++ * t->stride;
    }
    for (size_t i = from; i < *entry; i++) {
        qdot_motion_entry e = m->entries.at[i];

        e.i -= first;
        e.j -= first;
        couple(t, b, &e, rows);
    }
    return QDOT_OK;
}

qdot_status
qdot_taylor_solve_motion(qdot_taylor *t, int solved)
{
    const qdot_motion *m = t->motion;
    size_t *rows = qdot_calloc(m->solved.n + 1, sizeof *rows), entry = 0;
    qdot_status status = rows ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k + 1 < m->blocks.n && status == QDOT_OK; k++)
        status = solve_block(t, k, solved, &entry, rows);
    qdot_free(rows);
    return status;
}
