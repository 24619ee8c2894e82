/* sweep.c -- the statement `sweep`: a run for each member, numbers of it in a row.
 *
 * Each member is the run that `run ... with NAME = VALUE` would make; its columns are read again
 * while it is the latest run, with its values in force. So whatever stands after `value`, `print`
 * or `check` can be a column.
 */
#include <math.h>
#include <string.h>
#include <time.h>

#include "base/interrupt.h"
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
enum { MOST_PRINTED = 24 };

typedef struct {
    qdot_members members;
    qdot_columns columns;
    const char *name;
    qdot_row_table *table;
    size_t failed;
    bool interrupted;
} sweep;

/* --- reading ---------------------------------------------------------------------------- */

static qdot_status
read_rest(qdot_cursor *c, sweep *s)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "as")) {
            QDOT_TRY(qdot_cursor_once(c, "as", s->name != NULL));
            QDOT_TRY(qdot_read_name(c, &s->name));
        } else if (qdot_cursor_is_word(c, "threads") || qdot_cursor_is_word(c, "resume")) {
            c->error_at = c->at->start;
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: sweep ... %s", c->at->text);
        } else {
            return qdot_cursor_expected(c, "`as NAME` or the end of the statement");
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

/* The columns of the latest run, behind what was swept in the last row. */
static qdot_status
fill_columns(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const sweep *s = user;
    qdot_row_table *t = s->table;
    const size_t first = (t->rows - 1) * t->n + t->n_swept;

    (void)run;
    for (size_t i = 0; i < s->columns.at.n; i++) {
        qdot_expr e;

        QDOT_TRY(qdot_columns_read(c, &s->columns, i, &e));
        QDOT_TRY(measure(c->session, e, end, &t->values[first + i], &t->errors[first + i]));
    }
    return QDOT_OK;
}

static qdot_status
fill_row(qdot_cursor *c, sweep *s, size_t k)
{
    qdot_row_table *t = s->table;

    QDOT_TRY(qdot_row_table_add(t));
    for (size_t i = 0; i < t->n_swept; i++)
        t->errors[k * t->n + i] = 0;
    return qdot_members_run(c, &s->members, k, t->values + k * t->n, fill_columns, s);
}

/* --- the sweep -------------------------------------------------------------------------- */

/* Why row k failed. */
static qdot_status
note_failure(sweep *s, size_t k)
{
    s->failed++;
    s->table->reasons[k] = qdot_strdup(qdot_last_error()->message);
    return s->table->reasons[k] != NULL ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
run_all(qdot_cursor *c, sweep *s)
{
    const size_t start = c->error_at;

    for (size_t k = 0; k < s->members.axes.members; k++) {
        qdot_status status = fill_row(c, s, k);

        if (status == QDOT_EINTR && k > 0) {
            qdot_interrupt_clear(); /* heard: the rows that are done are kept */
            s->interrupted = true;
            s->table->rows = k;
            break;
        }
        if (qdot_members_all_fail(status))
            return status;
        if (status != QDOT_OK)
            QDOT_TRY(note_failure(s, k));
        if (c->session->json)
            QDOT_TRY(qdot_row_answer_json(c->session, s->table, k));
    }
    c->error_at = start;
    return QDOT_OK;
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
tell(qdot_session *session, const sweep *s, double cpu)
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
    qdot_text_format(&text, ", cpu %.3g s", cpu);
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
    const clock_t begun = clock();
    qdot_status status = run_all(c, s);
    qdot_row_table *table = s->table;

    if (status != QDOT_OK)
        return status;
    s->table = NULL;
    QDOT_TRY(qdot_row_tables_keep(c->session, table));
    s->table = table;
    status = tell(c->session, s, (double)(clock() - begun) / CLOCKS_PER_SEC);
    s->table = NULL;
    QDOT_TRY(status);
    if (s->interrupted)
        return qdot_fail(QDOT_EINTR, "interrupted: %s has the first %zu of %zu rows", table->name,
                         table->rows, s->members.axes.members);
    if (is_empty(table))
        return qdot_fail(QDOT_EFAILED, "all rows failed: %s", table->reasons[0]);
    return QDOT_OK;
}

qdot_status
qdot_sweep_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    sweep s = {.members.run.tol = 1e-12};
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
    return status;
}
