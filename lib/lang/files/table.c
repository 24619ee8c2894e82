/* table.c -- the statements `table` and `save`. */
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/table-answer.h"
#include "lang/commands/handlers.h"
#include "lang/declare/scene-file.h"
#include "lang/figures/figure-file.h"
#include "lang/runs/data-file.h"
#include "lang/files/digits-table.h"
#include "lang/files/row-file.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"

/* The number of significant digits in answers. */
enum { DIGITS = 10 };

/* --- columns of numbers ------------------------------------------------------------- */

typedef struct {
    qdot_table table;
    double *values; /* column by column */
    char **labels;
} grid;

static void
free_grid(grid *g)
{
    for (size_t i = 0; g->labels != NULL && i < g->table.n; i++)
        qdot_free(g->labels[i]);
    qdot_free(g->labels);
    qdot_free(g->values);
    qdot_free(g->table.columns);
}

static qdot_status
new_grid(grid *g, size_t n, size_t rows)
{
    g->table.n = n;
    g->table.rows = rows;
    g->values = qdot_calloc(n * rows, sizeof *g->values);
    g->labels = qdot_calloc(n, sizeof *g->labels);
    g->table.columns = qdot_calloc(n, sizeof *g->table.columns);
    if (g->values == NULL || g->labels == NULL || g->table.columns == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        g->table.columns[i] = (qdot_table_column){.digits = DIGITS, .gap = 2, .values = g->values + i * rows};
    return QDOT_OK;
}

/* The heading of column i: its label, "R", or "R[2]" for one component of several. */
static qdot_status
label_column(grid *g, size_t i, const char *label, size_t component, size_t components)
{
    qdot_text text = {0};

    qdot_text_add(&text, label);
    if (components > 1)
        qdot_text_format(&text, "[%zu]", component + 1);
    if (qdot_text_status(&text) != QDOT_OK) {
        qdot_text_clear(&text);
        return QDOT_ENOMEM;
    }
    g->labels[i] = text.at;
    g->table.columns[i].name = text.at;
    return QDOT_OK;
}

/* Fill t and every column of the operands at these times. */
static qdot_status
fill_grid(grid *g, const qdot_operands *list, size_t rows, const double *times)
{
    size_t n = 1, next = 1;

    for (size_t i = 0; i < list->n; i++)
        n += list->at[i].columns.n;
    QDOT_TRY(new_grid(g, n, rows));
    memcpy(g->values, times, rows * sizeof *times);
    QDOT_TRY(label_column(g, 0, "t", 0, 1));
    for (size_t i = 0; i < list->n; i++) {
        const qdot_operand *o = &list->at[i];

        QDOT_TRY(qdot_operands_values(o, rows, times, g->values + next * rows, NULL));
        for (size_t k = 0; k < o->columns.n; k++)
            QDOT_TRY(label_column(g, next + k, o->label, k, o->columns.n));
        next += o->columns.n;
    }
    return QDOT_OK;
}

/* Numbers of operand o, whose columns [m x rows] these are, that have no digit because they are beyond
 * the horizon of its run become NaN. *some: whether there are any. */
static qdot_status
blank_unknown(const qdot_operand *o, size_t rows, const double *times, double *columns,
              bool *some)
{
    const qdot_run_report *r = qdot_run_get_report(o->run);
    const size_t m = o->columns.n;
    double *values, *errors;
    size_t first = 0;
    qdot_status status;

    if (o->mixed || isnan(r->horizon))
        return QDOT_OK;
    while (first < rows && !qdot_run_report_is_beyond(r, times[first]))
        first++;
    values = qdot_calloc(2 * m * (rows - first) + 1, sizeof *values);
    errors = values + m * (rows - first);
    status = values == NULL ? QDOT_ENOMEM
                            : qdot_operands_values(o, rows - first, times + first, values, errors);
    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        for (size_t k = first; k < rows; k++) {
            const size_t at = i * (rows - first) + k - first;

            if (qdot_number_is_known(values[at], errors[at]))
                continue;
            columns[i * rows + k] = NAN;
            *some = true;
        }
    qdot_free(values);
    return status;
}

/* Blank the unknown values of all operands, with a notice. */
static qdot_status
blank_all_unknown(qdot_session *session, grid *g, const qdot_operands *list, const double *times)
{
    size_t next = 1;
    bool some = false;

    for (size_t i = 0; i < list->n; i++) {
        QDOT_TRY(blank_unknown(&list->at[i], g->table.rows, times, g->values + next * g->table.rows, &some));
        next += list->at[i].columns.n;
    }
    return some ? qdot_answer_notice(session, "- stands for numbers beyond the horizon of their run, "
                                              "of which no digit is known")
                : QDOT_OK;
}

/* The run to which all operands belong; NULL if there are several. */
static qdot_run *
only_run(const qdot_operands *list)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i].run != list->at[0].run || list->at[i].mixed)
            return NULL;
    return list->at[0].run;
}

/* Write to a file by its ending, or (path NULL) as an answer. run: that of all columns, or NULL. */
static qdot_status
write_grid(qdot_session *session, grid *g, qdot_run *run, const char *path)
{
    return path != NULL ? qdot_data_file_write(session, run, &g->table, path)
                        : qdot_answer_table(session, "table", &g->table);
}

/* --- table -------------------------------------------------------------------------- */

/* The time span that all the runs cover, in the direction of the first run. */
static qdot_status
common_span(const qdot_operands *list, double *from, double *to)
{
    const qdot_run_report *first = qdot_run_get_report(list->at[0].run);
    double low = -INFINITY, high = INFINITY;

    for (size_t i = 0; i < list->n; i++) {
        const qdot_run_report *one = qdot_run_get_report(list->at[i].run);

        low = fmax(low, fmin(one->t0, one->t1));
        high = fmin(high, fmax(one->t0, one->t1));
        if (list->at[i].mixed)
            QDOT_TRY(qdot_member_span(list->at[i].session, list->at[i].columns.at[0],
                                      &low, &high));
    }
    if (low > high)
        return qdot_fail(QDOT_EINVAL, "the runs have no time in common");
    *from = first->t1 >= first->t0 ? low : high;
    *to = first->t1 >= first->t0 ? high : low;
    return QDOT_OK;
}

/* The times t0, t0 + step, ... up to t1; if the runs go back in time they decrease. */
static qdot_status
ladder(const qdot_operands *list, double step, double **times, size_t *n)
{
    double from = 0, to = 0, span, count;

    if (!(step > 0))
        return qdot_fail(QDOT_EINVAL, "a table needs a step above 0");
    QDOT_TRY(common_span(list, &from, &to));
    span = to - from;
    count = floor(fabs(span) / step * (1 + 1e-12)) + 1;
    if (count > 1e7)
        return qdot_fail(QDOT_ELIMIT, "a table of %.3g rows is too long", count);
    *n = (size_t)count;
    *times = qdot_calloc(*n, sizeof **times);
    if (*times == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < *n; k++) {
        double t = from + copysign((double)k * step, span);

        (*times)[k] = span >= 0 ? fmin(t, to) : fmax(t, to);
    }
    return QDOT_OK;
}

static qdot_status
read_table(qdot_cursor *c, qdot_operands *list, qdot_expr *step, const char **path)
{
    bool every = false;

    QDOT_TRY(qdot_operands_read(c, list));
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "every")) {
            QDOT_TRY(qdot_cursor_once(c, "every", every));
            every = true;
            QDOT_TRY(qdot_read_scalar(c, step));
        } else if (qdot_cursor_accept_word(c, "to")) {
            const qdot_token *at = c->at;

            QDOT_TRY(qdot_figure_file_read(c, path));
            c->error_at = at->start;
            QDOT_TRY(qdot_data_file_check(*path));
        } else {
            return qdot_cursor_expected(c, "`every` or `to`");
        }
    }
    return every ? QDOT_OK : qdot_cursor_expected(c, "`every` and a step");
}

/* A table of runs with `digits`: its times are exact, counted from the first one. */
static qdot_status
exact_table(qdot_session *session, const qdot_operands *list, const double *times,
            qdot_expr step, size_t rows, const char *path)
{
    qdot_pool *pool = session->pool;
    const qdot_expr from = qdot_measured_rational(pool, times[0]);
    qdot_expr *at = qdot_calloc(rows + 1, sizeof *at);
    qdot_status status = at != NULL ? QDOT_OK : QDOT_ENOMEM;

    step = qdot_session_bind(session, qdot_measured_as_rationals(session, step));
    if (rows > 1 && times[1] < times[0])
        step = qdot_neg(pool, step);
    for (size_t k = 0; k < rows && status == QDOT_OK; k++) {
        at[k] = qdot_add(pool, from, qdot_mul(pool, qdot_expr_int(pool, (long)k), step));
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_digits_table(session, list, only_run(list), rows, at, NULL, path);
    qdot_free(at);
    return status;
}

qdot_status
qdot_table_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_operands list = {0};
    const char *path = NULL;
    double step = 0, *times = NULL;
    qdot_expr exact_step = QDOT_NIL;
    size_t rows = 0;
    grid g = {0};
    const qdot_row_table *table = qdot_row_file_named(c);
    qdot_status status;

    if (table != NULL)
        return qdot_row_file_statement(c, table);
    status = read_table(c, &list, &exact_step, &path);
    if (status == QDOT_OK)
        status = qdot_session_number(c->session, exact_step, &step, NULL);
    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = qdot_operands_find_runs(c->session, &list);
    }
    if (status == QDOT_OK)
        status = ladder(&list, step, &times, &rows);
    if (status == QDOT_OK && qdot_digits_table_of(&list) > 0) {
        status = exact_table(c->session, &list, times, exact_step, rows, path);
        qdot_free(times);
        qdot_operands_free(&list);
        return status;
    }
    if (status == QDOT_OK)
        status = fill_grid(&g, &list, rows, times);
    if (status == QDOT_OK && path == NULL && !c->session->json)
        status = blank_all_unknown(c->session, &g, &list, times);
    if (status == QDOT_OK)
        status = write_grid(c->session, &g, only_run(&list), path);
    free_grid(&g);
    qdot_free(times);
    qdot_operands_free(&list);
    return status;
}

/* --- save --------------------------------------------------------------------------- */

static qdot_status
push_symbol(qdot_session *session, qdot_run *run, qdot_expr symbol, qdot_operands *list)
{
    qdot_operand o = {.run = run};
    qdot_status status = qdot_pool_check(session->pool);

    if (status == QDOT_OK)
        status = qdot_vec_push(&o.columns, symbol);
    if (status == QDOT_OK) {
        o.label = qdot_strdup(qdot_expr_symbol(session->pool, symbol)->name);
        status = o.label == NULL ? QDOT_ENOMEM : qdot_vec_push(list, o);
    }
    if (status != QDOT_OK)
        qdot_operand_clear(&o);
    return status;
}

/* Every coordinate, velocity and multiplier of the run as operands. */
static qdot_status
whole_state(qdot_session *session, qdot_run *run, qdot_operands *list)
{
    const qdot_run_report *report = qdot_run_get_report(run);

    for (unsigned order = 0; order < 2; order++)
        for (size_t i = 0; i < report->n - (order > 0 ? report->n_states : 0); i++) {
            qdot_expr jet = qdot_symbol_jet(session->pool, report->coordinates[i], order);

            QDOT_TRY(push_symbol(session, run, jet, list));
        }
    for (size_t k = 0; k < report->m; k++)
        QDOT_TRY(push_symbol(session, run, report->multipliers[k], list));
    return QDOT_OK;
}

/* Save a run with `digits` at its steps; the last is the exact end of the run. */
static qdot_status
exact_save(qdot_session *session, const qdot_operands *list, qdot_run *run, size_t rows,
           const double *times, const char *path)
{
    qdot_expr *at = qdot_calloc(rows + 1, sizeof *at);
    bool *beside = qdot_calloc(rows + 1, sizeof *beside); /* an event, on either side */
    qdot_status status = at != NULL && beside != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < rows && status == QDOT_OK; k++) {
        if (k + 1 < rows)
            at[k] = qdot_measured_rational(session->pool, times[k]);
        beside[k] = qdot_run_is_before_event(run, k) || (k > 0 && qdot_run_is_before_event(run, k - 1));
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_digits_table(session, list, run, rows, at, beside, path);
    qdot_free(at);
    qdot_free(beside);
    return status;
}

/* At events, fill the earlier of two rows of the same time with the state before the event. */
static qdot_status
fill_before_events(qdot_run *run, const qdot_operands *list, grid *g)
{
    for (size_t k = 0; k < g->table.rows; k++) {
        if (!qdot_run_is_before_event(run, k))
            continue;
        for (size_t i = 0; i < list->n; i++) /* one column each */
            QDOT_TRY(qdot_run_point_values(run, 1, list->at[i].columns.at, k,
                                           g->values + (i + 1) * g->table.rows + k));
    }
    return QDOT_OK;
}

/* `save session to "FILE.lag"`, `save history ...`, at the name of the file. */
static qdot_status
save_statements(qdot_cursor *c, qdot_scene_file what)
{
    const qdot_token *name = c->at;

    if (!qdot_scene_file_is(name))
        return qdot_cursor_expected(c, "the name of a file in quotes, \"x.lag\"");
    c->at++;
    QDOT_TRY(qdot_cursor_expect_end(c));
    return qdot_scene_file_write(c, name, what);
}

qdot_status
qdot_table_save(qdot_cursor *c)
{
    const qdot_token *start = c->at, *file;
    const char *name = NULL, *path = NULL;
    qdot_operands list = {0};
    qdot_named_run *named;
    const double *times;
    qdot_status status;
    grid g = {0};
    size_t rows;

    if (qdot_row_file_named(c) != NULL)
        return qdot_row_file_statement(c, qdot_row_file_named(c));
    if (!qdot_cursor_is_word(c, "to"))
        QDOT_TRY(qdot_read_name(c, &name));
    if (!qdot_cursor_accept_word(c, "to"))
        return qdot_cursor_expected(c, "`to` and the name of a file");
    if (name != NULL && (strcmp(name, "session") == 0 || strcmp(name, "history") == 0) &&
        (qdot_scene_file_is(c->at) || qdot_runs_find(c->session, name, &named) != QDOT_OK))
        return save_statements(c, name[0] == 's' ? QDOT_FILE_SESSION : QDOT_FILE_HISTORY);
    file = c->at;
    QDOT_TRY(qdot_figure_file_read(c, &path));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = file->start;
    QDOT_TRY(qdot_data_file_check(path));
    c->error_at = start->start;
    QDOT_TRY(qdot_runs_find(c->session, name, &named));
    times = qdot_run_times(named->run, &rows);
    status = whole_state(c->session, named->run, &list);
    if (status == QDOT_OK && qdot_digits_table_of(&list) > 0) {
        status = exact_save(c->session, &list, named->run, rows, times, path);
        qdot_operands_free(&list);
        return status;
    }
    if (status == QDOT_OK)
        status = fill_grid(&g, &list, rows, times);
    if (status == QDOT_OK)
        status = fill_before_events(named->run, &list, &g);
    if (status == QDOT_OK)
        status = write_grid(c->session, &g, named->run, path);
    free_grid(&g);
    qdot_operands_free(&list);
    return status;
}
