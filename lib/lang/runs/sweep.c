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
#include "base/progress.h"
#include "lang/answer/answer.h"
#include "lang/answer/row-answer.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/runs/run-options.h"
#include "lang/runs/sweep-axis.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"

/* A table of so many rows is printed; of more, how it went. */
enum { MOST_PRINTED = 24 };

/* Where the members' runs are kept meanwhile: a name that nobody can write. */
static const char member_name[] = "the run";

typedef struct {
    qdot_sweep_axes axes;
    qdot_run_options run;
    qdot_vec(const qdot_token *) columns; /* the first token of each */
    const char *name;
    qdot_row_table *table;
    size_t failed;
    bool interrupted;
} sweep;

/* --- reading ---------------------------------------------------------------------------- */

/* The `:` between the run and the columns; NULL: there is none. */
static qdot_token *
find_colon(const qdot_cursor *c)
{
    const qdot_token *t = c->at;
    int depth = 0;

    for (; t->kind != QDOT_TOKEN_END && (depth > 0 || !qdot_token_is(t, ":")); t++)
        depth += qdot_token_bracket(t);
    return t->kind == QDOT_TOKEN_END ? NULL : (qdot_token *)t;
}

/* `run T0..T1 ...` up to the colon, which ends it meanwhile. */
static qdot_status
read_run(qdot_cursor *c, sweep *s)
{
    const qdot_token *start = c->at;
    qdot_token *colon = find_colon(c);
    uint8_t kind;
    qdot_status status;

    if (!qdot_cursor_accept_word(c, "run"))
        return qdot_cursor_expected(c, s->axes.random ? "`run T0..T1`, `count` or `seed`"
                                                      : "`,` or `run T0..T1`");
    if (colon == NULL) {
        while (!qdot_cursor_is_end(c))
            c->at++;
        (void)qdot_cursor_expected(c, "`:` and what is asked of each run");
        return qdot_hint("run 0..20 : max(theta), energy as curve");
    }
    kind = colon->kind;
    colon->kind = QDOT_TOKEN_END;
    status = qdot_read_range(c, &s->run.from, &s->run.to);
    if (status == QDOT_OK)
        status = qdot_run_options_read(c, start, &s->run);
    colon->kind = kind;
    QDOT_TRY(status);
    if (s->run.name != NULL) {
        c->error_at = start->start;
        (void)qdot_fail(QDOT_EINVAL, "the runs of a sweep have no names: `as` stands at its end");
        return qdot_hint("sweep ... run 0..20 : x as %s", s->run.name);
    }
    c->at++;
    return QDOT_OK;
}

static bool
ends_columns(const qdot_cursor *c)
{
    return qdot_cursor_is_end(c) || qdot_cursor_is_word(c, "as")
           || qdot_cursor_is_word(c, "threads") || qdot_cursor_is_word(c, "resume");
}

/* Where each column begins; what they are is read when there is a run. */
static qdot_status
find_columns(qdot_cursor *c, sweep *s)
{
    int depth = 0;

    if (ends_columns(c))
        return qdot_cursor_expected(c, "what is asked of each run: `max(theta), energy`");
    QDOT_TRY(qdot_vec_push(&s->columns, c->at));
    for (; depth > 0 ? !qdot_cursor_is_end(c) : !ends_columns(c); c->at++) {
        if (depth == 0 && qdot_token_is(c->at, ",")) {
            QDOT_TRY(qdot_vec_push(&s->columns, c->at + 1));
            continue;
        }
        depth += qdot_token_bracket(c->at);
    }
    return QDOT_OK;
}

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

    QDOT_TRY(qdot_sweep_axes_read(c, &s->axes));
    QDOT_TRY(read_run(c, s));
    QDOT_TRY(find_columns(c, s));
    start = c->at;
    QDOT_TRY(read_rest(c, s));
    if (s->name == NULL || qdot_names_find(c->session->names, s->name) == NULL)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", s->name);
}

/* --- a member --------------------------------------------------------------------------- */

/* A number, or an expression at the end of the run. */
static qdot_status
measure(qdot_session *session, qdot_expr e, const qdot_run_report *report, qdot_expr end,
        double *value, double *error)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION
                            | QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_measured m;

    if (!qdot_expr_is_scalar(session->pool, e))
        return qdot_fail(QDOT_ETYPE, "a column of a sweep is one number a run");
    if (!(qdot_expr_node(session->pool, e)->holds & moving))
        return qdot_session_number(session, e, value, error);
    if (report->status != QDOT_RUN_DONE)
        end = qdot_measured_rational(session->pool, report->t1);
    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, e), end,
                                   &m));
    *value = m.value;
    *error = m.error;
    return QDOT_OK;
}

/* A failure that no other member can mend. */
static bool
is_general(qdot_status status)
{
    return status == QDOT_ESYNTAX || status == QDOT_ENAME || status == QDOT_ETYPE
           || status == QDOT_ENOTBUILT || status == QDOT_EUNSET || status == QDOT_ENOMEM
           || status == QDOT_EINTR;
}

/* The columns of the latest run. */
static qdot_status
fill_columns(qdot_cursor *c, const sweep *s, const qdot_run_report *report, qdot_expr end,
             double *values, double *errors)
{
    for (size_t i = 0; i < s->columns.n; i++) {
        qdot_cursor own = *c;
        qdot_expr e;
        qdot_status status;

        own.at = s->columns.at[i];
        own.error_at = own.at->start;
        status = qdot_read_side(&own, &e);
        if (status == QDOT_OK && !qdot_token_is(own.at, ",") && !ends_columns(&own))
            status = qdot_cursor_expected(&own, "`,`, `as NAME` or the end of the statement");
        if (status == QDOT_OK)
            own.error_at = s->columns.at[i]->start;
        if (status == QDOT_OK)
            status = measure(c->session, e, report, end, &values[i], &errors[i]);
        c->error_at = own.error_at;
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* Make the member's run, and the rest of its row. */
static qdot_status
run_member(qdot_cursor *c, const sweep *s, double *values, double *errors)
{
    qdot_session *session = c->session;
    const size_t measured = session->measured.n;
    qdot_request request = {0};
    qdot_run *run = NULL;
    qdot_status status = qdot_run_options_fill(session, &s->run, &request);

    if (status == QDOT_OK)
        status = qdot_request_limits(session, s->run.from, s->run.to, &request);
    if (status == QDOT_OK)
        status = qdot_request_explain(session, &request,
                                      qdot_run_new(session->scene, &request.request, &run));
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (run != NULL && status == QDOT_OK) {
        const qdot_run_report *report = qdot_run_get_report(run);

        status = qdot_runs_keep(session, member_name, "", &request.request, run);
        if (status == QDOT_OK && report->status == QDOT_RUN_FAILED)
            status = qdot_fail(QDOT_EFAILED, "%s",
                               report->reason != NULL ? report->reason : "the run failed");
        if (status == QDOT_OK)
            status = fill_columns(c, s, report, request.request.t1, values, errors);
    } else {
        qdot_run_free(run);
    }
    if (session->runs.n > 0
        && strcmp(session->runs.at[session->runs.n - 1].name, member_name) == 0)
        qdot_named_run_release(&session->runs.at[--session->runs.n]);
    session->measured.n = measured;
    qdot_request_free(&request);
    return status;
}

/* Row k of the table: the values of the axes, in force while the member is run. */
static qdot_status
fill_row(qdot_cursor *c, sweep *s, size_t k)
{
    qdot_session *session = c->session;
    qdot_row_table *table = s->table;
    double *const values = table->values + k * table->n, *const errors = table->errors + k * table->n;
    const size_t n = s->axes.at.n;
    qdot_kept_values kept;
    qdot_status status = QDOT_OK;

    for (size_t i = n; i < table->n; i++)
        values[i] = errors[i] = NAN;
    QDOT_TRY(qdot_session_keep_values(session, &kept));
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_sweep_axis *x = &s->axes.at.at[i];
        const qdot_expr value = qdot_sweep_axes_value(session, &s->axes, k, i);

        status = qdot_pool_check(session->pool);
        if (status == QDOT_OK)
            status = qdot_session_number(session, value, &values[i], NULL);
        if (status == QDOT_OK && qdot_expr_is_class(session->pool, x->symbol, QDOT_COORD))
            status = qdot_session_start(session, x->symbol, value);
        else if (status == QDOT_OK)
            qdot_session_set(session, x->symbol, value, &status);
    }
    if (status == QDOT_OK)
        status = run_member(c, s, values + n, errors + n);
    qdot_session_restore_values(session, &kept);
    return status;
}

/* --- the sweep -------------------------------------------------------------------------- */

static qdot_status
run_all(qdot_cursor *c, sweep *s)
{
    const size_t start = c->error_at;

    for (size_t k = 0; k < s->axes.members && !s->interrupted; k++) {
        qdot_status status = fill_row(c, s, k);

        if (status == QDOT_EINTR && k > 0) {
            qdot_interrupt_clear(); /* heard: the rows that are done are kept */
            s->interrupted = true;
            break;
        }
        if (is_general(status))
            return status;
        if (status != QDOT_OK) {
            s->failed++;
            s->table->reasons[k] = qdot_strdup(qdot_last_error()->message);
            if (s->table->reasons[k] == NULL)
                return QDOT_ENOMEM;
        }
        s->table->rows++;
        if (c->session->json)
            QDOT_TRY(qdot_row_answer_json(c->session, s->table, k));
    }
    c->error_at = start;
    return QDOT_OK;
}

static qdot_status
make_table(qdot_session *session, sweep *s, const qdot_token *end)
{
    const size_t n = s->axes.at.n + s->columns.n;
    const char **labels = qdot_calloc(n, sizeof *labels);
    qdot_text *texts = qdot_calloc(s->columns.n, sizeof *texts);
    qdot_status status = labels && texts ? QDOT_OK : QDOT_ENOMEM;
    char next[32];

    if (s->name == NULL)
        qdot_row_tables_next_name(session, next, sizeof next);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const size_t k = i - s->axes.at.n;

        if (i < s->axes.at.n) {
            labels[i] = s->axes.at.at[i].label;
            continue;
        }
        qdot_token_text(session, s->columns.at[k],
                        k + 1 < s->columns.n ? s->columns.at[k + 1] - 1 : end, &texts[k]);
        status = qdot_text_status(&texts[k]);
        labels[i] = qdot_text_str(&texts[k]);
    }
    if (status == QDOT_OK) {
        s->table = qdot_row_table_new(s->name != NULL ? s->name : next, s->axes.at.n, n, labels,
                                      s->axes.members);
        status = s->table ? QDOT_OK : QDOT_ENOMEM;
    }
    if (s->table != NULL)
        s->table->drawn = s->axes.random;
    for (size_t i = 0; texts && i < s->columns.n; i++)
        qdot_text_clear(&texts[i]);
    qdot_free(texts);
    qdot_free(labels);
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
    if (s->axes.random)
        qdot_text_format(&text, ", seed %lu", s->axes.seed);
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
                         table->rows, s->axes.members);
    if (is_empty(table))
        return qdot_fail(QDOT_EFAILED, "all rows failed: %s", table->reasons[0]);
    return QDOT_OK;
}

qdot_status
qdot_sweep_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    sweep s = {.run = {.tol = 1e-12}};
    const qdot_token *end = NULL;
    qdot_status status = read_sweep(c, &s);

    for (end = s.columns.n > 0 ? s.columns.at[s.columns.n - 1] : c->at;
         status == QDOT_OK && !ends_columns(&(qdot_cursor){.at = end}); end++)
        ;
    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = make_table(c->session, &s, end);
    }
    if (status == QDOT_OK)
        status = carry_out(c, &s);
    qdot_run_options_place(c, &s.run, status);
    qdot_row_table_release(s.table);
    qdot_sweep_axes_free(&s.axes);
    qdot_run_options_free(&s.run);
    qdot_free(s.columns.at);
    return status;
}
