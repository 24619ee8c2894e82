/* sweep.c -- the statement `sweep`: a run for each member, numbers of it in a row.
 *
 * Each member is the run that `run ... with NAME = VALUE` would make; its columns are read again
 * while it is the latest run, with its values in force. So whatever stands after `value`, `print`
 * or `check` can be a column.
 */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/process.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/answer/row-answer.h"
#include "lang/commands/warnings.h"
#include "lang/declare/scene-file.h"
#include "lang/language/token-text.h"
#include "lang/session/output.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "lang/sweeps/sweep-parts.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_sweep(qdot_record *r);

QDOT_STATEMENT(sweep) = {
    .word = "sweep",
    .group = QDOT_NUMBERS,
    .usage = "sweep " QDOT_MEMBERS_USAGE "EXPR, ... [as NAME] [threads N] [resume \"FILE.h5\"]",
    .summary = "a run for each value of parameters or initial values - A..B, a list [V, W], or drawn by normal(M, S), "
               "uniform(A, B) - with numbers of it as a row, each with its error: `table NAME`, `plot NAME`, "
               "`save NAME to` show them; `mpirun -n N qdot FILE` divides it among machines",
    .example = "sweep omega = 0..5 step 0.1 run 0..20 : value(theta, 20)",
    .handler = carry_out_sweep,
};

enum { MOST_THREADS = 1024 };

/* --- reading the statement -------------------------------------------------------------- */

static qdot_status
read_number_of_threads(qdot_record *r, qdot_sweep *s)
{
    const qdot_filled *part = qdot_record_hole(r, "threads", "N");

    if (part == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_integer(r, part, &s->threads));
    if (s->threads >= 1 && s->threads <= MOST_THREADS)
        return QDOT_MAY_THREAD || s->threads == 1
                   ? QDOT_OK
                   : qdot_answer_notice(r->cursor.session,
                                        "this program was built with --disable-threads: one process makes all rows");
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EINVAL, "threads are from 1 to %d", MOST_THREADS);
}

/* Read the name of the file in which the rows of the sweep are stored. */
static qdot_status
read_file_name(qdot_record *r, qdot_sweep *s)
{
    const qdot_filled *part = qdot_record_hole(r, "resume", NULL);

    if (part == NULL)
        return QDOT_OK;
    s->path_at = part->from;
    s->path = qdot_record_text(part);
    if (qdot_ends_in(s->path, ".h5"))
        return QDOT_OK;
    qdot_record_blame(r, part);
    (void)qdot_fail(QDOT_EINVAL, "rows are kept in a file whose name ends in .h5");
    return qdot_hint("resume \"rows.h5\"");
}

static qdot_status
read_sweep_name(qdot_record *r, qdot_sweep *s)
{
    const qdot_filled *part = qdot_record_hole(r, "as", "NAME");

    return part != NULL ? qdot_record_new_name(r, part, &s->name) : QDOT_OK;
}

static qdot_status
read_sweep_operands(qdot_sweep *s)
{
    qdot_record *r = s->record;

    QDOT_TRY(qdot_members_find(r, &s->members));
    QDOT_TRY(qdot_columns_find(r, &s->columns));
    QDOT_TRY(read_number_of_threads(r, s));
    QDOT_TRY(read_file_name(r, s));
    return read_sweep_name(r, s);
}

/* Write the text of the sweep's statement and a hash (FNV-1a) of its scene, as it would be saved, to identify it. */
static qdot_status
write_identifying_text(qdot_sweep *s)
{
    qdot_text scene = {0};
    uint64_t hash = 0xcbf29ce484222325;
    qdot_status status = qdot_scene_file_text(s->c->session, QDOT_FILE_SCENE, &scene);

    for (size_t i = 0; i < scene.n; i++)
        hash = (hash ^ (unsigned char)scene.at[i]) * 0x100000001b3;
    qdot_token_text(s->c->session, s->record->start, s->columns.at.at[s->columns.at.n - 1]->to, &s->said);
    qdot_text_format(&s->said, "\nscene %016llx", (unsigned long long)hash);
    qdot_text_clear(&scene);
    return status == QDOT_OK ? qdot_text_status(&s->said) : status;
}

static qdot_status
make_table(qdot_session *session, qdot_sweep *s)
{
    const qdot_sweep_axes *axes = &s->members.axes;
    qdot_columns_before *swept = qdot_calloc(axes->at.n + 1, sizeof *swept);
    qdot_status status;
    char next[32];

    if (swept == NULL)
        return QDOT_ENOMEM;
    if (s->name == NULL)
        qdot_row_tables_next_name(session, next, sizeof next);
    for (size_t i = 0; i < axes->at.n; i++)
        swept[i] = (qdot_columns_before){axes->at.at[i].label, axes->at.at[i].symbol};
    status = qdot_columns_table(session, &s->columns, s->name != NULL ? s->name : next,
                                axes->at.n, swept, &s->table);
    if (s->table != NULL)
        s->table->scattered = axes->random;
    qdot_free(swept);
    return status;
}

/* The number of finished rows that contain a number whose error is unknown. */
static size_t
count_rows_of_unknown_error(const qdot_row_table *t)
{
    size_t rows = 0;

    for (size_t k = 0; k < t->rows; k++) {
        bool some = false;

        for (size_t i = t->n_swept; i < t->n; i++)
            some = some || isnan(t->errors[k * t->n + i]);
        rows += some && t->reasons[k] == NULL;
    }
    return rows;
}

static qdot_status
answer_sweep(qdot_session *session, const qdot_sweep *s, const qdot_row_table *t, double seconds)
{
    qdot_text text = {0};

    if (session->output->json)
        return QDOT_OK;
    qdot_text_format(&text, "%s: %zu row%s", t->name, t->rows, t->rows == 1 ? "" : "s");
    if (s->members.axes.random)
        qdot_text_format(&text, ", seed %" PRIu64, s->members.axes.seed);
    if (s->failed > 0)
        qdot_text_format(&text, ", %zu failed", s->failed);
    if (count_rows_of_unknown_error(t) > 0)
        qdot_text_format(&text, ", the errors of %zu unknown", count_rows_of_unknown_error(t));
    if (s->resumed > 0)
        qdot_text_format(&text, ", %zu of them from %s", s->resumed, s->path);
    qdot_text_format(&text, ", in %.3g s", seconds);
    qdot_text_char(&text, '\n');
    QDOT_TRY(qdot_answer_written(session, t->name, QDOT_OK, &text));
    return t->rows <= QDOT_ROWS_PRINTED ? qdot_row_answer(session, t) : QDOT_OK;
}

/* Whether no row of the table has any of the requested numbers. */
static bool
has_no_numbers(const qdot_row_table *t)
{
    bool empty = t->rows > 0;

    for (size_t k = 0; k < t->rows; k++)
        for (size_t i = t->n_swept; i < t->n; i++)
            empty = empty && t->reasons[k] != NULL && isnan(t->values[k * t->n + i]);
    return empty;
}

/* Give the notice of a run of the sweep once more, for instance that its start was moved onto the constraints. */
static qdot_status
repeat_notice(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const char *notice = qdot_run_get_report(run)->notice;
    bool *told = user;

    (void)end;
    if (notice == NULL)
        return QDOT_OK;
    *told = true;
    return qdot_answer_notice(c->session, "of a run of the sweep: %.*s",
                              (int)strcspn(notice, "\n"), notice);
}

/* Whether a start value is swept, or given by the option `with`. */
static bool
sets_start_values(const qdot_session *session, const qdot_members *m)
{
    for (size_t i = 0; i < m->axes.at.n; i++)
        if (qdot_session_is_start(session->pool, m->axes.at.at[i].symbol))
            return true;
    return qdot_run_options_name_start(session->pool, &m->run);
}

/* Give the notices about the start of the first, middle and last run of a sweep, as its rows do not show them. */
static qdot_status
give_notices_of_starts(qdot_cursor *c, const qdot_members *m)
{
    const size_t members = m->axes.members, looked[] = {0, members / 2, members - 1};
    double *swept = qdot_calloc(m->axes.at.n + 1, sizeof *swept);
    qdot_status status = swept != NULL ? QDOT_OK : QDOT_ENOMEM;
    bool told = false;

    for (size_t i = 0; i < 3 && swept != NULL && !told; i++) {
        status = qdot_members_begin(c, m, looked[i], swept, repeat_notice, &told);
        if (status == QDOT_ENOMEM || status == QDOT_EINTR)
            break;
        status = QDOT_OK; /* a failure is no error here: the row of the run gives the reason */
    }
    qdot_free(swept);
    return status;
}

/* Record the parameters that have the same value in all rows. */
static qdot_status
record_constant_parameters(qdot_session *session, const qdot_members *m, qdot_row_table *table)
{
    const size_t n = m->axes.at.n;
    double *swept = qdot_calloc(n + 1, sizeof *swept);
    qdot_expr *open = qdot_calloc(n + 1, sizeof *open);
    qdot_trial trial;
    qdot_status status = swept && open ? qdot_trial_begin(&trial, session) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        for (size_t i = 0; i < n; i++)
            open[i] = m->axes.at.at[i].symbol;
        status = qdot_members_set(session, m, 0, swept);
        if (status == QDOT_OK)
            status = qdot_row_tables_note_parameters(session, table, n, open);
        else
            status = qdot_grave(status); /* a failure is no error here: the row of the run gives the reason */
        qdot_trial_end(&trial);
    }
    qdot_free(swept);
    qdot_free(open);
    return status;
}

static qdot_status
run_sweep(qdot_cursor *c, qdot_sweep *s)
{
    const double begun = qdot_wall_now();
    qdot_row_table *table = s->table;

    QDOT_TRY(record_constant_parameters(c->session, &s->members, table));
    QDOT_TRY(qdot_sweep_make_rows(s));
    s->table = NULL; /* now owned by the session */
    QDOT_TRY(qdot_row_tables_keep(c->session, table));
    QDOT_TRY(answer_sweep(c->session, s, table, qdot_wall_now() - begun));
    if (!sets_start_values(c->session, &s->members))
        QDOT_TRY(qdot_warnings_start(c->session));
    if (!s->interrupted)
        QDOT_TRY(give_notices_of_starts(c, &s->members));
    if (s->interrupted)
        return qdot_fail(QDOT_EINTR, "interrupted: %s has %zu of %zu rows", table->name,
                         table->rows, s->members.axes.members);
    if (has_no_numbers(table))
        return qdot_fail(QDOT_EFAILED, "all rows failed: %s", table->reasons[0]);
    return QDOT_OK;
}

static void
free_sweep(qdot_sweep *s)
{
    qdot_file_lock_release(&s->lock);
    qdot_row_table_release(s->table);
    qdot_members_free(&s->members);
    qdot_columns_free(&s->columns);
    qdot_text_clear(&s->said);
    qdot_free(s->done);
}

static qdot_status
carry_out_sweep(qdot_record *r)
{
    qdot_sweep s = {.members.run.tol = 1e-12, .record = r, .c = &r->cursor};
    qdot_status status = read_sweep_operands(&s);

    if (status == QDOT_OK) {
        r->cursor.error_at = r->start->start;
        status = make_table(s.c->session, &s);
    }
    if (status == QDOT_OK && s.path != NULL)
        status = write_identifying_text(&s);
    if (status == QDOT_OK) {
        s.table->members = qdot_function_body_new(r->cursor.source, r->start, r->cursor.at);
        status = s.table->members ? run_sweep(s.c, &s) : QDOT_ENOMEM;
    }
    qdot_run_options_place(s.c, s.members.run.method_at, status);
    free_sweep(&s);
    return status;
}

qdot_status
qdot_sweep_plan(qdot_record *r)
{
    qdot_sweep s = {.members.run.tol = 1e-12, .record = r, .c = &r->cursor};
    qdot_text text = {0};
    qdot_status status = read_sweep_operands(&s);

    if (status == QDOT_OK) {
        r->cursor.error_at = r->start[1].start;
        status = make_table(s.c->session, &s);
    }
    if (status == QDOT_OK)
        status = qdot_sweep_tell_plan(&s, &text);
    qdot_run_options_place(s.c, s.members.run.method_at, status);
    status = qdot_answer_written(s.c->session, "plan", status, &text);
    free_sweep(&s);
    return status;
}
