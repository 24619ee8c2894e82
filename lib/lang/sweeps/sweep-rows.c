/* sweep-rows.c -- makes the rows of a sweep, in this process or in others, and stores them in a file. */
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "lang/answer/row-answer.h"
#include "lang/session/trial.h"
#include "lang/session/output.h"
#include "lang/sweeps/sweep-file.h"
#include "lang/sweeps/sweep-lanes.h"
#include "lang/sweeps/sweep-parts.h"
#include "lang/sweeps/sweep-ranks.h"
#include "parallel/ranks.h"
#include "parallel/workers.h"

/* the least remaining work, in seconds, for which it pays to start further processes */
static const double worth = 0.05;

/* The largest and the smallest number of rows that this process makes together in vector lanes. */
enum { MOST = 256, LEAST = 32 };

/* the desired duration, in seconds, of making a group of rows together; an interruption would lose the group */
static const double soon = 0.5;

/* --- making a row ----------------------------------------------------------------------- */

/* The columns of the latest run, behind what was swept in its row; of those that fail the first is
 * told. */
static qdot_status
evaluate_columns(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const qdot_sweep *s = user;
    qdot_row_table *t = s->table;
    const size_t first = s->row * t->n + t->n_swept;
    qdot_status failed = QDOT_OK;
    qdot_error why;

    (void)run;
    for (size_t i = 0; i < s->columns.at.n; i++) {
        const qdot_status status = qdot_columns_measure(c, &s->columns, i, end,
                                                        &t->values[first + i],
                                                        &t->errors[first + i]);

        if (status == QDOT_ENOMEM || status == QDOT_EINTR)
            return status;
        if (status != QDOT_OK && failed == QDOT_OK) {
            failed = status;
            why = *qdot_last_error();
        }
    }
    return failed == QDOT_OK ? QDOT_OK : qdot_fail_again(&why);
}

qdot_status
qdot_sweep_fill_row(qdot_sweep *s, size_t k)
{
    qdot_row_table *t = s->table;
    qdot_status status;

    if (s->lanes != NULL && qdot_sweep_lanes_made(s->lanes, k, &status))
        return status;
    s->row = k;
    for (size_t i = 0; i < t->n_swept; i++)
        t->errors[k * t->n + i] = 0;
    return qdot_members_run(s->c, &s->members, k, t->values + k * t->n, evaluate_columns, s);
}

/* --- storing rows in a file ----------------------------------------------------------- */

/* Write the finished rows to the file if the last write was long ago, or now if `at_once`. */
static qdot_status
write_rows_to_file(qdot_sweep *s, bool at_once)
{
    double now;

    if (s->path == NULL || qdot_rank() > 0)
        return QDOT_OK;
    now = qdot_wall_now();
    if (!at_once && now - s->kept_at < fmax(1, 20 * s->keeping))
        return QDOT_OK;
    QDOT_TRY(qdot_sweep_file_keep(s->table, s->done, qdot_text_str(&s->said), s->path));
    s->kept_at = qdot_wall_now();
    s->keeping = s->kept_at - now;
    return QDOT_OK;
}

/* --- finished rows of the sweep --------------------------------------------------------- */

/* Answer the finished rows that come next as JSON; `all`: also the rest. */
static qdot_status
answer_finished_rows(qdot_sweep *s, bool all)
{
    const size_t from = s->told;

    while (s->c->session->output->json && s->told < s->table->rows && (all || s->done[s->told]))
        s->told++;
    return s->told > from ? qdot_row_answer_part(s->c->session, s->table, from, s->told) : QDOT_OK;
}

/* Record that row k is finished, or has failed with that status and the last error. */
static qdot_status
record_finished_row(qdot_sweep *s, size_t k, qdot_status status)
{
    qdot_row_table *t = s->table;

    if (qdot_trial_all_fail(status))
        return status;
    if (status != QDOT_OK) {
        s->failed++;
        t->reasons[k] = qdot_strdup(qdot_last_error()->message);
        if (t->reasons[k] == NULL)
            return QDOT_ENOMEM;
    }
    s->done[k] = true;
    s->n_done++;
    QDOT_TRY(answer_finished_rows(s, false));
    return write_rows_to_file(s, false);
}

/* --- rows made by other processes ------------------------------------------------------- */

/* The head of a worker's message about a row; numbers, errors, and a failure's message and hint follow. */
typedef struct {
    qdot_status status;
    size_t error_at, message, hint;
} row_head;

/* Make rows together in vector lanes if they allow it; any failure will be reported by the single runs. */
static void
make_rows_in_worker(size_t first, size_t count, void *user)
{
    qdot_sweep *s = user;

    if (qdot_sweep_lanes_run(s->lanes, first, count) != QDOT_OK)
        return;
}

static void
make_row_in_worker(size_t k, qdot_text *answer, void *user)
{
    qdot_sweep *s = user;
    const qdot_row_table *t = s->table;
    const size_t bytes = t->n * sizeof *t->values;
    row_head h = {.status = qdot_sweep_fill_row(s, k), .error_at = s->c->error_at};
    const qdot_error *error = qdot_last_error();

    if (h.status != QDOT_OK) {
        h.message = strlen(error->message);
        h.hint = strlen(error->hint);
    }
    qdot_text_add_n(answer, (const char *)&h, sizeof h);
    qdot_text_add_n(answer, (const char *)(t->values + k * t->n), bytes);
    qdot_text_add_n(answer, (const char *)(t->errors + k * t->n), bytes);
    qdot_text_add_n(answer, error->message, h.message);
    qdot_text_add_n(answer, error->hint, h.hint);
}

static qdot_status
take_row_from_worker(size_t k, const char *bytes, size_t n, void *user)
{
    qdot_sweep *s = user;
    qdot_row_table *t = s->table;
    const size_t numbers = t->n * sizeof *t->values;
    row_head h;

    if (bytes == NULL || n < sizeof h + 2 * numbers)
        return record_finished_row(s, k, qdot_fail(QDOT_EFAILED, "the process that made the run has ended"));
    memcpy(&h, bytes, sizeof h);
    bytes += sizeof h;
    memcpy(t->values + k * t->n, bytes, numbers);
    memcpy(t->errors + k * t->n, bytes + numbers, numbers);
    bytes += 2 * numbers;
    if (h.status != QDOT_OK) {
        (void)qdot_fail(h.status, "%.*s", (int)h.message, bytes);
        if (h.hint > 0)
            (void)qdot_hint("%.*s", (int)h.hint, bytes + h.message);
        if (qdot_trial_all_fail(h.status))
            s->c->error_at = h.error_at;
    }
    return record_finished_row(s, k, h.status);
}

/* --- making all rows -------------------------------------------------------------------- */

/* The number of rows to make together next, if the last `before` rows took this number of seconds. */
static size_t
next_group_size(size_t before, double seconds)
{
    if (seconds > soon)
        return before / 2 > LEAST ? before / 2 : LEAST;
    return seconds < soon / 2 && before < MOST ? 2 * before : before;
}

/* Make the rows first ... end - 1 that are not finished, in this process. */
static qdot_status
make_rows_in_this_process(qdot_sweep *s, size_t first, size_t end)
{
    size_t together = LEAST;
    double begun = qdot_wall_now();

    for (size_t k = first, next = first; k < end; k++) {
        qdot_progress_at((double)k);
        if (s->lanes != NULL && k == next) {
            const double now = qdot_wall_now();

            together = k > first ? next_group_size(together, now - begun) : LEAST;
            begun = now;
            next = end - k < together ? end : k + together;
            QDOT_TRY(qdot_sweep_lanes_run(s->lanes, k, next - k));
        }
        if (!s->done[k])
            QDOT_TRY(record_finished_row(s, k, qdot_sweep_fill_row(s, k)));
    }
    return QDOT_OK;
}

/* The first row here, for what it costs; then the others, by several processes if that is worth it. With
 * other ranks all rows at once, so that none waits. */
static qdot_status
make_all_rows(qdot_sweep *s)
{
    const size_t members = s->members.axes.members, side = s->lanes != NULL ? LEAST : 1;
    const double begun = qdot_wall_now();
    size_t first = 0;
    qdot_workers_job job = {.end = members, .skip = s->done, .user = s, .work = make_row_in_worker,
                            .done = take_row_from_worker, .workers = qdot_sweep_processes(s)};

    if (s->lanes != NULL) {
        job.begin = make_rows_in_worker;
        job.least = LEAST;
    }
    qdot_progress_begin(0, (double)members, "sweep");
    if (qdot_ranks_count() > 1)
        return qdot_workers_run(&job);
    while (first < members && s->done[first])
        first++;
    job.first = members - first > side ? first + side : members;
    QDOT_TRY(make_rows_in_this_process(s, first, job.first));
    job.seconds = (qdot_wall_now() - begun) / (double)(job.first > first ? job.first - first : 1);
    if (s->threads == 0 && job.seconds * (double)(members - first) < worth)
        job.workers = 1;
    if (job.workers > members - job.first)
        job.workers = members - job.first;
    return job.workers > 1 ? qdot_workers_run(&job) : make_rows_in_this_process(s, job.first, members);
}

/* Remove the rows whose runs are not finished from the table. */
static void
drop_unfinished_rows(qdot_sweep *s)
{
    qdot_row_table *t = s->table;
    size_t n = 0;

    for (size_t k = 0; k < t->rows; k++) {
        if (!s->done[k])
            continue;
        memmove(t->values + n * t->n, t->values + k * t->n, t->n * sizeof *t->values);
        memmove(t->errors + n * t->n, t->errors + k * t->n, t->n * sizeof *t->errors);
        t->reasons[n++] = t->reasons[k];
    }
    t->rows = n;
}

/* Begin the table of the sweep, with the rows that a file of an earlier call has kept. */
static qdot_status
begin_table(qdot_sweep *s)
{
    const size_t members = s->members.axes.members;

    s->done = qdot_calloc(members + 1, sizeof *s->done);
    if (s->done == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_row_table_add_all(s->table, members));
    if (s->path == NULL || qdot_rank() > 0)
        return QDOT_OK;
    s->c->error_at = s->path_at->start;
    QDOT_TRY(qdot_file_lock_acquire(s->path, &s->lock));
    QDOT_TRY(qdot_sweep_file_take(s->path, qdot_text_str(&s->said), s->table, s->done));
    for (size_t k = 0; k < members; k++) {
        s->failed += s->done[k] && s->table->reasons[k] != NULL;
        s->resumed += s->done[k];
    }
    s->n_done = s->resumed;
    return write_rows_to_file(s, true); /* write now, so that an unwritable file is reported early */
}

qdot_status
qdot_sweep_make_rows(qdot_sweep *s)
{
    const size_t start = s->c->error_at;
    qdot_text why = {0}; /* reason why the rows are not made together in lanes, for `plan sweep` */
    qdot_status status;

    QDOT_TRY(begin_table(s));
    s->c->error_at = start;
    s->kept_at = qdot_wall_now();
    status = qdot_sweep_lanes_new(s, &s->lanes, &why);
    if (status == QDOT_OK)
        status = make_all_rows(s);
    status = qdot_sweep_share_rows(s, status);
    qdot_sweep_lanes_free(s->lanes);
    qdot_text_clear(&why);
    s->lanes = NULL;
    if (status == QDOT_EINTR && s->n_done > 0) {
        qdot_interrupt_clear(); /* the interruption is handled here: keep the finished rows */
        s->interrupted = true;
        status = QDOT_OK;
    }
    QDOT_TRY(status);
    s->c->error_at = start;
    QDOT_TRY(write_rows_to_file(s, true));
    if (s->interrupted)
        drop_unfinished_rows(s);
    return answer_finished_rows(s, true);
}
