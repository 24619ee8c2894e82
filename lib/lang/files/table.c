/* table.c -- the statement `table`: numbers along runs, and the rows of many runs. */
#include <math.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "lang/answer/answer.h"
#include "lang/answer/write.h"
#include "lang/runs/data-file.h"
#include "lang/files/digits-table.h"
#include "lang/files/grid.h"
#include "lang/files/row-file.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/output.h"

static qdot_status answer_table_statement(qdot_record *r);

QDOT_STATEMENT(table) = {
    .word = "table",
    .group = QDOT_NUMBERS,
    .usage = "table EXPR, ... every DT [to \"FILE.csv|.json|.txt|.html|.h5\"] | table ROWS [to \"FILE.csv\"]",
    .summary = "a table along the latest run, or of the rows of a sweep, a section, branches",
    .example = "table theta, theta', energy every 0.1",
    .handler = answer_table_statement,
};

/* Numbers of operand o, whose columns [m x rows] these are, that have no digit because they are beyond
 * the horizon of its run become NaN. *some: whether there are any. */
static qdot_status
blank_unknown_values(const qdot_operand *o, size_t rows, const double *times, double *columns,
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

/* Blank the values of all operands that are not known, and give a notice of that. */
static qdot_status
blank_all_unknown(qdot_session *session, qdot_grid *g, const qdot_operands *list, const double *times)
{
    size_t next = 1;
    bool some = false;

    for (size_t i = 0; i < list->n; i++) {
        QDOT_TRY(blank_unknown_values(&list->at[i], g->table.rows, times, g->values + next * g->table.rows, &some));
        next += list->at[i].columns.n;
    }
    return some ? qdot_answer_notice(session, "- marks numbers beyond the horizon of their run, "
                                              "of which no digit is known")
                : QDOT_OK;
}

/* The only run to which all operands belong; NULL if there are several. */
static qdot_run *
find_only_run(const qdot_operands *list)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i].run != list->at[0].run || list->at[i].mixed)
            return NULL;
    return list->at[0].run;
}

/* Find the time range common to all the runs, in the direction of the first run. */
static qdot_status
find_common_time_range(const qdot_operands *list, double *from, double *to)
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

/* Make the list of times t0, t0 + step, ... up to t1; it decreases if the runs go back in time. */
static qdot_status
make_evenly_spaced_times(const qdot_operands *list, double step, double **times, size_t *n)
{
    double from = 0, to = 0, span, count;

    if (!(step > 0))
        return qdot_fail(QDOT_EINVAL, "a table needs a step above 0");
    QDOT_TRY(find_common_time_range(list, &from, &to));
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

/* Read the step after `every`, and the path after `to`; NULL if there is no file. */
static qdot_status
read_table_options(qdot_record *r, qdot_expr *step, const char **path)
{
    const qdot_filled *file = qdot_record_hole(r, "to", NULL);

    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, "every", NULL), step));
    if (file == NULL)
        return QDOT_OK;
    *path = qdot_record_text(file);
    qdot_record_blame(r, file);
    return qdot_data_file_check(*path);
}

/* Make a table of runs made with the option `digits`; its times are exact, counted from the first one. */
static qdot_status
make_table_with_digits(qdot_session *session, const qdot_operands *list, const double *times,
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
        at[k] = qdot_add(pool, from, qdot_mul(pool, qdot_expr_int(pool, (int64_t)k), step));
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_digits_table(session, list, find_only_run(list), rows, at, NULL, path);
    qdot_free(at);
    return status;
}

/* Answer or write a table of values along runs. */
static qdot_status
answer_table_along_runs(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_operands list = {0};
    const char *path = NULL;
    double step = 0, *times = NULL;
    qdot_expr exact_step = QDOT_NIL;
    size_t rows = 0;
    qdot_grid g = {0};
    qdot_status status = qdot_operands_find(r, qdot_record_hole(r, "table", "EXPR"), &list);

    if (status == QDOT_OK)
        status = read_table_options(r, &exact_step, &path);
    if (status == QDOT_OK)
        status = qdot_session_number(session, exact_step, &step, NULL);
    if (status == QDOT_OK) {
        r->cursor.error_at = r->start->start;
        status = qdot_operands_find_runs(session, &list);
    }
    if (status == QDOT_OK)
        status = make_evenly_spaced_times(&list, step, &times, &rows);
    if (status == QDOT_OK && qdot_digits_table_of(&list) > 0) {
        status = make_table_with_digits(session, &list, times, exact_step, rows, path);
        qdot_free(times);
        qdot_operands_free(&list);
        return status;
    }
    g.measured = path == NULL && qdot_write_displays(session);
    if (status == QDOT_OK)
        status = qdot_grid_fill(&g, &list, rows, times);
    if (status == QDOT_OK && path == NULL && !session->output->json)
        status = blank_all_unknown(session, &g, &list, times);
    if (status == QDOT_OK)
        status = qdot_grid_write(session, &g, find_only_run(&list), path);
    qdot_grid_free(&g);
    qdot_free(times);
    qdot_operands_free(&list);
    return status;
}

static qdot_status
answer_table_statement(qdot_record *r)
{
    const qdot_filled *rows = qdot_record_hole(r, "table", "ROWS");

    return rows == NULL ? answer_table_along_runs(r)
                        : qdot_row_file_answer(r, qdot_row_tables_find(r->cursor.session, rows->from->text));
}
