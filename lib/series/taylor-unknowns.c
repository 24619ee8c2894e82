/* taylor-unknowns.c -- unknowns of a motion: how they are coupled, and what their equations read. */
#include <string.h>

#include "base/memory.h"
#include "series/taylor-motion.h"
#include "series/taylor-products.h"
#include "series/taylor-steps.h"

/* Add an empty block for n coupled unknowns with up to `count` products (couplings) between them. */
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

/* Count the products of a variable entry (i, j) of the matrix K with unknown j, for each explicit equation. */
static void
count_coupling(const qdot_motion *m, const qdot_motion_entry *e, size_t is_explicit, size_t *rows)
{
    if (m->program.rows.at[e->at].still)
        return;
    rows[e->i] += e->i < is_explicit;
    rows[e->j] += e->i != e->j && e->j < is_explicit;
}

static void
add_coupling(qdot_taylor *t, qdot_taylor_block *b, const qdot_motion_entry *e, size_t is_explicit,
             size_t *next)
{
    const qdot_motion *m = t->motion;
    const double *M = qdot_taylor_place(t, e->at);

    if (m->program.rows.at[e->at].still)
        return;
    if (e->i < is_explicit)
        b->couplings[next[e->i]++] = (qdot_taylor_coupling){e->i, M, b->a[e->j]};
    if (e->i != e->j && e->j < is_explicit)
        b->couplings[next[e->j]++] = (qdot_taylor_coupling){e->j, M, b->a[e->i]};
}

/* Entries of a motion are those of its first block, then of the next: *entry is where those of
 * block k begin, then where they end. rows [solved + 1] is scratch. */
static qdot_status
make_solved_block(qdot_taylor *t, size_t k, int solved, size_t *entry, size_t *rows)
{
    const qdot_motion *m = t->motion;
    const uint32_t first = m->blocks.at[k], end = m->blocks.at[k + 1];
    const size_t n = end - first, from = *entry;
    /* number of the block's unknowns whose equations are explicit */
    const size_t is_explicit = m->right.n > first ? m->right.n - first : 0;
    size_t count = 0;
    qdot_taylor_block *b;

    memset(rows, 0, (m->solved.n + 1) * sizeof *rows);
    while (*entry < m->entries.n && m->entries.at[*entry].i < end) {
        qdot_motion_entry e = m->entries.at[(*entry)++];

        e.i -= first;
        e.j -= first;
        count_coupling(m, &e, is_explicit, rows);
    }
    for (size_t i = 0; i < n; i++) { /* replace counts by starting positions */
        const size_t of_row = rows[i];

        rows[i] = count;
        count += of_row;
    }
    QDOT_TRY(add_block(t, n, count, solved, &b));
    b->n_couplings = count;
    for (size_t i = 0; i < n; i++) {
        b->f[i] = i < is_explicit ? qdot_taylor_place(t, m->right.at[first + i]) : NULL;
        b->a[i] = qdot_taylor_place(t, m->unknowns.at[m->solved.at[first + i]].row);
        b->r[i] = t->coefficients + t->spare++ * t->stride;
    }
    for (size_t i = from; i < *entry; i++) {
        qdot_motion_entry e = m->entries.at[i];

        e.i -= first;
        e.j -= first;
        add_coupling(t, b, &e, is_explicit, rows);
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
        status = make_solved_block(t, k, solved, &entry, rows);
    qdot_free(rows);
    return status;
}

/* --- rows that equations read --------------------------------------------------------- */

qdot_status
qdot_taylor_find_unknowns(qdot_taylor *t, bool linked)
{
    const qdot_motion *m = t->motion;

    t->unknowns = qdot_calloc(m->solved.n + 1, sizeof *t->unknowns);
    if (!t->unknowns)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m->solved.n; i++) {
        const qdot_motion_unknown *of = m->unknowns.at + m->solved.at[i];
        const bool is_explicit = i < m->right.n;

        t->unknowns[i] = (struct qdot_taylor_unknown){
            .row = qdot_taylor_place(t, of->row),
            .once = linked ? NULL : qdot_taylor_place(t, of->once),
            .twice = linked ? NULL : qdot_taylor_place(t, of->twice),
            .right =
                qdot_taylor_place(t, is_explicit ? m->right.at[i] : m->equations.at[i]),
            .is_explicit = is_explicit};
    }
    return QDOT_OK;
}

/* Count, for each row, the operands of steps that read it. */
static void
count_reads(const qdot_taylor *t, uint32_t *reads)
{
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++) {
        reads[qdot_taylor_row(t, s->x)]++;
        reads[qdot_taylor_row(t, s->y)]++;
        reads[qdot_taylor_row(t, s->z)]++;
    }
}

/* Resolve rates from the last step on, so that the rate of a rate is found first. */
static void
resolve_rates(qdot_taylor *t, uint32_t *reads)
{
    for (const qdot_taylor_step *s = t->steps + t->length; s-- > t->steps;)
        for (size_t i = 0; s->op == QDOT_T_RATE && i < t->motion->solved.n; i++) {
            struct qdot_taylor_unknown *u = t->unknowns + i;

            if (u->right != s->to || u->rates == 2 || reads[qdot_taylor_row(t, s->to)] > 0)
                continue;
            u->right = s->x;
            u->rates++;
            reads[qdot_taylor_row(t, s->x)] -= 3; /* x, y and z are the same row, which was counted three times */
        }
}

/* Remove steps whose rows nothing reads, by the counts reads [rows]. */
static void
remove_unread_steps(qdot_taylor *t, const uint32_t *reads)
{
    size_t n = 0, still = 0;

    for (size_t i = 0; i < t->length; i++) {
        const qdot_taylor_step *s = t->steps + i;
        const bool goes = (s->op == QDOT_T_RATE || s->op == QDOT_T_NEG) &&
                          reads[qdot_taylor_row(t, s->to)] == 0;

        if (goes)
            continue;
        still += i < t->still;
        t->steps[n++] = *s;
    }
    t->steps[n] = t->steps[t->length];
    t->length = n;
    t->still = still;
}

qdot_status
qdot_taylor_shorten(qdot_taylor *t)
{
    const qdot_motion *m = t->motion;
    uint32_t *reads = qdot_calloc(t->rows + 1, sizeof *reads);

    if (!reads)
        return QDOT_ENOMEM;
    count_reads(t, reads);
    resolve_rates(t, reads);
    for (size_t i = 0; i < m->solved.n; i++)
        reads[qdot_taylor_row(t, t->unknowns[i].right)]++;
    for (size_t i = 0; i < m->entries.n; i++) {
        double sign;

        reads[qdot_taylor_row(t, qdot_taylor_entry(t, m->entries.at[i].at, &sign))]++;
    }
    for (size_t i = 0; i < m->program.outputs.n; i++)
        reads[m->program.outputs.at[i]]++;
    remove_unread_steps(t, reads);
    qdot_free(reads);
    t->convolutions = (double)qdot_taylor_products_count(t->products);
    for (size_t i = t->still; i < t->length; i++)
        t->convolutions += qdot_recurrence_cost(t->steps[i].op);
    return QDOT_OK;
}

/* Find for each row whether steps read it at its newest order: read [rows]. */
static void
find_rows_read_at_newest(const qdot_taylor *t, bool *read)
{
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++) {
        read[qdot_taylor_row(t, s->x)] |= (s->newest & QDOT_X_NEWEST) != 0;
        read[qdot_taylor_row(t, s->y)] |= (s->newest & QDOT_Y_NEWEST) != 0;
        read[qdot_taylor_row(t, s->z)] |= (s->newest & QDOT_Z_NEWEST) != 0;
    }
}

static void
append_newest_row(qdot_taylor *t, const bool *read, double *row, int lead)
{
    if (row && read[qdot_taylor_row(t, row)])
        t->newest[t->n_newest++] = (struct qdot_taylor_newest){
            .row = row, .change = qdot_taylor_change_of(t, row), .lead = lead};
}

qdot_status
qdot_taylor_find_newest(qdot_taylor *t)
{
    const size_t n = t->motion->solved.n;
    bool *read = qdot_calloc(t->rows + 1, sizeof *read);

    t->newest = qdot_calloc(3 * n + 1, sizeof *t->newest);
    if (!t->newest || !read) {
        qdot_free(read);
        return QDOT_ENOMEM;
    }
    find_rows_read_at_newest(t, read);
    for (size_t i = 0; i < n; i++) {
        append_newest_row(t, read, t->unknowns[i].row, 0);
        append_newest_row(t, read, t->unknowns[i].once, 1);
        append_newest_row(t, read, t->unknowns[i].twice, 2);
    }
    qdot_free(read);
    return QDOT_OK;
}
