/* sweep-ranks.c -- sends the rows of a sweep from MPI rank 0 to the other ranks. */
#include "lang/sweeps/sweep-ranks.h"

#include <stdint.h>
#include <string.h>

#include "parallel/ranks.h"
#include "parallel/workers.h"

/* The result of the sweep, as rank 0 sends it to the other MPI ranks. */
typedef struct {
    uint64_t done, failed, resumed;
} sweep_end;

/* The head of a row in a message; the row's numbers, errors and reason [reason] follow. */
typedef struct {
    uint64_t row, reason; /* index of the row; length of its reason, UINT64_MAX: none */
} row_head;

enum { TOGETHER = 1 << 16 }; /* number of rows sent in one message */

size_t
qdot_sweep_processes(const qdot_sweep *s)
{
    if (!QDOT_MAY_THREAD)
        return 1;
    if (s->threads > 0)
        return (size_t)s->threads;
    return qdot_ranks_are_there() ? 1 : qdot_workers_processors();
}

static void
pack_rows(const qdot_sweep *s, size_t first, size_t end, qdot_text *out)
{
    const qdot_row_table *t = s->table;

    for (size_t k = first; k < end; k++) {
        const char *reason = t->reasons[k];
        const row_head h = {k, reason != NULL ? strlen(reason) : UINT64_MAX};

        if (!s->done[k])
            continue;
        qdot_text_add_n(out, (const char *)&h, sizeof h);
        qdot_text_add_n(out, (const char *)(t->values + k * t->n),
                        t->n * sizeof *t->values);
        qdot_text_add_n(out, (const char *)(t->errors + k * t->n),
                        t->n * sizeof *t->errors);
        if (reason != NULL)
            qdot_text_add_n(out, reason, (size_t)h.reason);
    }
}

/* Unpack rows of the sweep that rank 0 has packed; its data need no checks. */
static qdot_status
unpack_rows(qdot_sweep *s, const char *at, const char *end)
{
    qdot_row_table *t = s->table;
    const size_t bytes = t->n * sizeof *t->values;
    row_head h;

    while (at < end) {
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

/* Send the rows of the sweep to the other MPI ranks in blocks. */
static qdot_status
send_rows_in_blocks(qdot_sweep *s, qdot_text *text)
{
    const size_t rows = s->table->rows;

    for (size_t k = 0; k < rows; k += TOGETHER) {
        qdot_text_truncate(text, 0);
        if (qdot_rank() == 0)
            pack_rows(s, k, rows - k < TOGETHER ? rows : k + TOGETHER, text);
        QDOT_TRY(qdot_ranks_share(qdot_text_status(text), text));
        if (qdot_rank() > 0 && text->n > 0)
            QDOT_TRY(unpack_rows(s, text->at, text->at + text->n));
    }
    return QDOT_OK;
}

qdot_status
qdot_sweep_share_rows(qdot_sweep *s, qdot_status status)
{
    sweep_end all = {s->n_done, s->failed, s->resumed};
    const qdot_error *error = qdot_last_error();
    qdot_error why;
    qdot_text text = {0};
    qdot_status shared = QDOT_OK;

    if (qdot_ranks_count() == 1)
        return status;
    if (qdot_rank() == 0)
        qdot_text_add_n(&text, (const char *)&all, sizeof all);
    status = qdot_ranks_share(status, &text);
    why = *error;
    if (qdot_rank() > 0 && text.n == sizeof all) {
        memcpy(&all, text.at, sizeof all);
        s->n_done = (size_t)all.done;
        s->failed = (size_t)all.failed;
        s->resumed = (size_t)all.resumed;
    }
    if (status == QDOT_OK || status == QDOT_EINTR)
        shared = send_rows_in_blocks(s, &text);
    qdot_text_clear(&text);
    if (shared != QDOT_OK)
        return shared;
    return status == QDOT_OK ? QDOT_OK : qdot_fail_again(&why);
}
