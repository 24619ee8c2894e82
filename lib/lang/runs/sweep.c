/* sweep.c -- the statement `sweep`: a run for each member, numbers of it in a row.
 *
 * Each member is the run that `run ... with NAME = VALUE` would make; its columns are read again
 * while it is the latest run, with its values in force. So whatever stands after `value`, `print`
 * or `check` can be a column.
 */
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "base/workers.h"
#include "lang/answer/answer.h"
#include "lang/answer/row-answer.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/runs/columns.h"
#include "lang/runs/members.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"

/* A table of so many rows is printed; of more, how it went. */
enum { MOST_PRINTED = 24, MOST_THREADS = 1024 };

/* Seconds of work that are worth more than one process. */
static const double worth = 0.05;

typedef struct {
    qdot_members members;
    qdot_columns columns;
    const char *name;
    long threads; /* processes at work at once; 0: as many as there are processors */
    qdot_row_table *table;
    bool *done; /* [members] */
    size_t told; /* rows that JSON has, the first of all */
    size_t failed;
    bool interrupted;
    qdot_cursor *c;
    size_t row; /* that is being made */
} sweep;

/* --- reading ---------------------------------------------------------------------------- */

static qdot_status
read_threads(qdot_cursor *c, sweep *s)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_cursor_once(c, "threads", s->threads != 0));
    QDOT_TRY(qdot_read_integer(c, &s->threads));
    if (s->threads >= 1 && s->threads <= MOST_THREADS)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "threads are from 1 to %d", MOST_THREADS);
}

static qdot_status
read_rest(qdot_cursor *c, sweep *s)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "as")) {
            QDOT_TRY(qdot_cursor_once(c, "as", s->name != NULL));
            QDOT_TRY(qdot_read_name(c, &s->name));
        } else if (qdot_cursor_accept_word(c, "threads")) {
            QDOT_TRY(read_threads(c, s));
        } else if (qdot_cursor_is_word(c, "resume")) {
            c->error_at = c->at->start;
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: sweep ... %s", c->at->text);
        } else {
            return qdot_cursor_expected(c, "`as NAME`, `threads N` or the end of the statement");
        }
    }
    return QDOT_OK;
}

static qdot_status
read_sweep(qdot_cursor *c, sweep *s)
{
    const qdot_token *start;

    QDOT_TRY(qdot_members_read(c, &s->members));
    QDOT_TRY(qdot_columns_find(c, &s->columns));
    start = c->at;
    QDOT_TRY(read_rest(c, s));
    if (s->name == NULL || qdot_names_find(c->session->names, s->name) == NULL)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", s->name);
}

/* --- a row ------------------------------------------------------------------------------ */

/* A number, or an expression at the end of the run. */
static qdot_status
measure(qdot_session *session, qdot_expr e, qdot_expr end, double *value, double *error)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION
                            | QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_measured m;

    if (!(qdot_expr_node(session->pool, e)->holds & moving))
        return qdot_session_number(session, e, value, error);
    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, e), end,
                                   &m));
    *value = m.value;
    *error = m.error;
    return QDOT_OK;
}

/* The columns of the latest run, behind what was swept in its row. */
static qdot_status
fill_columns(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const sweep *s = user;
    qdot_row_table *t = s->table;
    const size_t first = s->row * t->n + t->n_swept;

    (void)run;
    for (size_t i = 0; i < s->columns.at.n; i++) {
        qdot_expr e;

        QDOT_TRY(qdot_columns_read(c, &s->columns, i, &e));
        QDOT_TRY(measure(c->session, e, end, &t->values[first + i], &t->errors[first + i]));
    }
    return QDOT_OK;
}

static qdot_status
fill_row(sweep *s, size_t k)
{
    qdot_row_table *t = s->table;

    s->row = k;
    for (size_t i = 0; i < t->n_swept; i++)
        t->errors[k * t->n + i] = 0;
    return qdot_members_run(s->c, &s->members, k, t->values + k * t->n, fill_columns, s);
}

/* Row k has been made, or has failed with that status and the last error. */
static qdot_status
take_row(sweep *s, size_t k, qdot_status status)
{
    qdot_row_table *t = s->table;

    if (qdot_members_all_fail(status))
        return status;
    if (status != QDOT_OK) {
        s->failed++;
        t->reasons[k] = qdot_strdup(qdot_last_error()->message);
        if (t->reasons[k] == NULL)
            return QDOT_ENOMEM;
    }
    s->done[k] = true;
    for (; s->c->session->json && s->told < t->rows && s->done[s->told]; s->told++)
        QDOT_TRY(qdot_row_answer_json(s->c->session, t, s->told));
    return QDOT_OK;
}

/* --- rows made by other processes ------------------------------------------------------- */

/* What a worker answers: this, the numbers and their errors, the message and the hint of a failure. */
typedef struct {
    qdot_status status;
    size_t error_at, message, hint;
} row_head;

static void
work_on_row(size_t k, qdot_text *answer, void *user)
{
    sweep *s = user;
    const qdot_row_table *t = s->table;
    const size_t bytes = t->n * sizeof *t->values;
    row_head h = {.status = fill_row(s, k), .error_at = s->c->error_at};
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
take_answer(size_t k, const char *bytes, size_t n, void *user)
{
    sweep *s = user;
    qdot_row_table *t = s->table;
    const size_t numbers = t->n * sizeof *t->values;
    row_head h;

    if (bytes == NULL || n < sizeof h + 2 * numbers)
        return take_row(s, k, qdot_fail(QDOT_EFAILED, "the process that made the run has ended"));
    memcpy(&h, bytes, sizeof h);
    bytes += sizeof h;
    memcpy(t->values + k * t->n, bytes, numbers);
    memcpy(t->errors + k * t->n, bytes + numbers, numbers);
    bytes += 2 * numbers;
    if (h.status != QDOT_OK) {
        (void)qdot_fail(h.status, "%.*s", (int)h.message, bytes);
        if (h.hint > 0)
            (void)qdot_hint("%.*s", (int)h.hint, bytes + h.message);
        if (qdot_members_all_fail(h.status))
            s->c->error_at = h.error_at;
    }
    return take_row(s, k, h.status);
}

/* --- the sweep -------------------------------------------------------------------------- */

/* Rows first ... members - 1, in this process. */
static qdot_status
run_here(sweep *s, size_t first, size_t end)
{
    for (size_t k = first; k < end; k++) {
        qdot_progress_at((double)k);
        QDOT_TRY(take_row(s, k, fill_row(s, k)));
    }
    return QDOT_OK;
}

/* The first row here, for what it costs; then the others, by several processes if that is worth it. */
static qdot_status
run_all(sweep *s)
{
    const size_t members = s->members.axes.members;
    const double begun = qdot_wall_now();
    qdot_workers_job job = {.first = 1, .end = members, .user = s, .work = work_on_row,
                            .done = take_answer};

    QDOT_TRY(run_here(s, 0, members > 0));
    job.seconds = qdot_wall_now() - begun;
    job.workers = s->threads > 0 ? (size_t)s->threads : qdot_workers_processors();
    if (s->threads == 0 && job.seconds * (double)members < worth)
        job.workers = 1;
    if (job.workers > members - 1)
        job.workers = members - 1;
    qdot_progress_begin(0, (double)members, "sweep");
    return job.workers > 1 ? qdot_workers_run(&job) : run_here(s, 1, members);
}

/* Leave the rows that are done. */
static void
drop_others(sweep *s)
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

/* All rows, or those that are done when Ctrl-C is pressed. */
static qdot_status
make_rows(sweep *s)
{
    const size_t start = s->c->error_at;
    qdot_status status = QDOT_OK;

    s->done = qdot_calloc(s->members.axes.members + 1, sizeof *s->done);
    if (s->done == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < s->members.axes.members && status == QDOT_OK; k++)
        status = qdot_row_table_add(s->table);
    if (status == QDOT_OK)
        status = run_all(s);
    if (status == QDOT_EINTR && s->done[0]) {
        qdot_interrupt_clear(); /* heard: the rows that are done are kept */
        s->interrupted = true;
        status = QDOT_OK;
        drop_others(s);
        for (; s->c->session->json && s->told < s->table->rows && status == QDOT_OK; s->told++)
            status = qdot_row_answer_json(s->c->session, s->table, s->told);
    }
    if (status == QDOT_OK)
        s->c->error_at = start;
    return status;
}

static qdot_status
make_table(qdot_session *session, sweep *s)
{
    const qdot_sweep_axes *axes = &s->members.axes;
    const char **swept = qdot_calloc(axes->at.n + 1, sizeof *swept);
    qdot_status status;
    char next[32];

    if (swept == NULL)
        return QDOT_ENOMEM;
    if (s->name == NULL)
        qdot_row_tables_next_name(session, next, sizeof next);
    for (size_t i = 0; i < axes->at.n; i++)
        swept[i] = axes->at.at[i].label;
    status = qdot_columns_table(session, &s->columns, s->name != NULL ? s->name : next,
                                axes->at.n, swept, &s->table);
    if (s->table != NULL)
        s->table->scattered = axes->random;
    qdot_free(swept);
    return status;
}

static qdot_status
tell(qdot_session *session, const sweep *s, double seconds)
{
    const qdot_row_table *t = s->table;
    qdot_text text = {0};

    if (session->json)
        return QDOT_OK;
    qdot_text_format(&text, "%s: %zu rows", t->name, t->rows);
    if (s->members.axes.random)
        qdot_text_format(&text, ", seed %lu", s->members.axes.seed);
    if (s->failed > 0)
        qdot_text_format(&text, ", %zu failed", s->failed);
    qdot_text_format(&text, ", in %.3g s", seconds);
    qdot_text_char(&text, '\n');
    QDOT_TRY(qdot_answer_written(session, t->name, QDOT_OK, &text));
    return t->rows <= MOST_PRINTED ? qdot_row_answer(session, t) : QDOT_OK;
}

/* Whether no row has a number that was asked for. */
static bool
is_empty(const qdot_row_table *t)
{
    bool empty = t->rows > 0;

    for (size_t k = 0; k < t->rows; k++)
        for (size_t i = t->n_swept; i < t->n; i++)
            empty = empty && t->reasons[k] != NULL && isnan(t->values[k * t->n + i]);
    return empty;
}

static qdot_status
carry_out(qdot_cursor *c, sweep *s)
{
    const double begun = qdot_wall_now();
    qdot_status status = make_rows(s);
    qdot_row_table *table = s->table;

    if (status != QDOT_OK)
        return status;
    s->table = NULL;
    QDOT_TRY(qdot_row_tables_keep(c->session, table));
    s->table = table;
    status = tell(c->session, s, qdot_wall_now() - begun);
    s->table = NULL;
    QDOT_TRY(status);
    if (s->interrupted)
        return qdot_fail(QDOT_EINTR, "interrupted: %s has %zu of %zu rows", table->name,
                         table->rows, s->members.axes.members);
    if (is_empty(table))
        return qdot_fail(QDOT_EFAILED, "all rows failed: %s", table->reasons[0]);
    return QDOT_OK;
}

qdot_status
qdot_sweep_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    sweep s = {.members.run.tol = 1e-12, .c = c};
    qdot_status status = read_sweep(c, &s);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = make_table(c->session, &s);
    }
    if (status == QDOT_OK) {
        s.table->members = qdot_function_body_new(c->source, start, s.columns.at.at[0]);
        status = s.table->members ? carry_out(c, &s) : QDOT_ENOMEM;
    }
    qdot_run_options_place(c, &s.members.run, status);
    qdot_row_table_release(s.table);
    qdot_members_free(&s.members);
    qdot_columns_free(&s.columns);
    qdot_free(s.done);
    return status;
}
