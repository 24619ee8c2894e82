/* sweep-ranks.c -- the rows of a sweep, from rank 0 to the others. */
#include "lang/sweeps/sweep-ranks.h"

#include <stdint.h>
#include <string.h>

#include "base/ranks.h"
#include "base/workers.h"

/* Before all rows; before the numbers of each, their errors and its reason [reason]. */
typedef struct {
    uint64_t rows, failed, resumed;
} rows_head;
typedef struct {
    uint64_t row, reason; /* UINT64_MAX: none */
} row_head;

size_t
qdot_sweep_processes(const qdot_sweep *s)
{
    if (s->threads > 0)
        return (size_t)s->threads;
    return qdot_ranks_are_there() ? 1 : qdot_workers_processors();
}

static void
pack(const qdot_sweep *s, qdot_text *out)
{
    const qdot_row_table *t = s->table;
    const rows_head all = {s->n_done, s->failed, s->resumed};

    qdot_text_add_n(out, (const char *)&all, sizeof all);
    for (size_t k = 0; k < t->rows; k++) {
        const char *reason = t->reasons[k];
        const row_head h = {k, reason != NULL ? strlen(reason) : UINT64_MAX};

        if (!s->done[k])
            continue;
        qdot_text_add_n(out, (const char *)&h, sizeof h);
        qdot_text_add_n(out, (const char *)(t->values + k * t->n), t->n * sizeof *t->values);
        qdot_text_add_n(out, (const char *)(t->errors + k * t->n), t->n * sizeof *t->errors);
        if (reason != NULL)
            qdot_text_add_n(out, reason, (size_t)h.reason);
    }
}

/* What rank 0 has packed; its own bytes are of the right form. */
static qdot_status
unpack(qdot_sweep *s, const char *at)
{
    qdot_row_table *t = s->table;
    const size_t bytes = t->n * sizeof *t->values;
    rows_head all;
    row_head h;

    memcpy(&all, at, sizeof all);
    at += sizeof all;
    s->n_done = (size_t)all.rows;
    s->failed = (size_t)all.failed;
    s->resumed = (size_t)all.resumed;
    for (size_t i = 0; i < s->n_done; i++) {
        memcpy(&h, at, sizeof h);
        at += sizeof h;
        memcpy(t->values + h.row * t->n, at, bytes);
        memcpy(t->errors + h.row * t->n, at + bytes, bytes);
        at += 2 * bytes;
        s->done[h.row] = true;
        if (h.reason == UINT64_MAX)
            continue;
        t->reasons[h.row] = qdot_strndup(at, (size_t)h.reason);
        if (t->reasons[h.row] == NULL)
            return QDOT_ENOMEM;
        at += h.reason;
    }
    return QDOT_OK;
}

qdot_status
qdot_sweep_share_rows(qdot_sweep *s, qdot_status status)
{
    qdot_text text = {0};

    if (qdot_ranks_count() == 1)
        return status;
    if (qdot_rank() == 0)
        pack(s, &text);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    status = qdot_ranks_share(status, &text);
    if (qdot_rank() > 0 && text.n > 0 && unpack(s, text.at) != QDOT_OK)
        status = QDOT_ENOMEM;
    qdot_text_clear(&text);
    return status;
}
