/* workprecision.c -- error against time, every method: a table, a figure, a file. */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/number-text.h"
#include "base/wrap.h"
#include "lang/answer/answer.h"
#include "lang/figures/figure-option.h"
#include "lang/runs/error-time.h"
#include "lang/runs/request.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "sim/study/workprecision.h"

typedef struct {
    qdot_figure_choice figure;
    qdot_panel_choice panel;
} choices;

/* The columns, in the order of every form. */
enum { COLUMNS = 13, CONSTRAINT_ERR = 10 };

static const char *const names[COLUMNS] = {
    "method", "tol",      "err",        "scd",            "time_min", "time_median", "evals",
    "steps",  "rejected", "energy_err", "constraint_err", "ref_err",  "status"};

/* The column of constraint errors stands only where there are constraints. */
static bool
has_column(const qdot_workprecision *w, size_t i)
{
    return i != CONSTRAINT_ERR || w->constraints;
}

/* The numbers of a row, columns 1 ... 11. */
static void
numbers_of(const qdot_workprecision *w, const qdot_workprecision_row *r, double *x)
{
    const double all[COLUMNS - 2] = {
        r->tol,          r->err,           r->scd,              r->time_min,
        r->time_median,  (double)r->evals, (double)r->steps,    (double)r->rejected,
        r->energy_err,   r->constraint_err, w->ref_err};

    memcpy(x, all, sizeof all);
}

/* --- a file of values ---------------------------------------------------------------- */

static void
csv_field(qdot_text *out, const char *field)
{
    if (strpbrk(field, ",\"\n") == NULL) {
        qdot_text_add(out, field);
        return;
    }
    qdot_text_char(out, '"');
    for (; *field != '\0'; field++) {
        if (*field == '"')
            qdot_text_char(out, '"');
        qdot_text_char(out, *field);
    }
    qdot_text_char(out, '"');
}

static void
csv(const void *study, qdot_text *out)
{
    const qdot_workprecision *w = study;

    for (size_t i = 0; i < COLUMNS; i++)
        if (has_column(w, i))
            qdot_text_format(out, "%s%s", names[i], i + 1 < COLUMNS ? "," : "\n");
    for (size_t k = 0; k < w->n; k++) {
        double x[COLUMNS - 2];

        numbers_of(w, &w->rows[k], x);
        qdot_text_add(out, w->rows[k].method);
        for (size_t i = 0; i < COLUMNS - 2; i++) {
            if (!has_column(w, i + 1))
                continue;
            qdot_text_char(out, ',');
            if (!isnan(x[i]))
                qdot_text_double(out, x[i], i == 0 ? 1 : 17);
        }
        qdot_text_char(out, ',');
        csv_field(out, w->rows[k].status);
        qdot_text_char(out, '\n');
    }
}

/* --- a table ------------------------------------------------------------------------- */

/* A cell, right-aligned; nothing for what is not known. */
static void
cell(qdot_text *out, int width, const char *format, double x)
{
    char text[40] = "-";

    if (!isnan(x))
        snprintf(text, sizeof text, format, x);
    qdot_text_format(out, QDOT_WRAP_CELL "%*s", width, text);
}

static void
table(const void *study, qdot_text *out)
{
    const qdot_workprecision *w = study;
    static const struct {
        const char *head, *format;
        int width, column;
    } shown[] = {{"tol", "%.0e", 7, 0},      {"err", "%.1e", 9, 1},
                 {"scd", "%.1f", 6, 2},      {"time/s", "%.2e", 10, 3},
                 {"median", "%.2e", 10, 4},  {"evals", "%.0f", 9, 5},
                 {"steps", "%.0f", 8, 6},    {"rejected", "%.0f", 9, 7},
                 {"energy err", "%.1e", 11, 8}, {"constr. err", "%.1e", 12, 9}};
    const size_t n = sizeof shown / sizeof *shown;

    qdot_text_format(out, "%-12s", "method");
    for (size_t i = 0; i < n; i++)
        if (has_column(w, (size_t)shown[i].column + 1))
            qdot_text_format(out, QDOT_WRAP_CELL "%*s", shown[i].width, shown[i].head);
    qdot_text_add(out, QDOT_WRAP_CELL "  status\n");
    for (size_t k = 0; k < w->n; k++) {
        double x[COLUMNS - 2];

        numbers_of(w, &w->rows[k], x);
        qdot_text_format(out, "%-12s", w->rows[k].method);
        for (size_t i = 0; i < n; i++)
            if (has_column(w, (size_t)shown[i].column + 1))
                cell(out, shown[i].width, shown[i].format, x[shown[i].column]);
        qdot_text_format(out, QDOT_WRAP_CELL "  %s\n", w->rows[k].status);
    }
    qdot_text_add(out, "err: the largest error at the end, each relative to max(1, "
                       "|value|), against a reference whose own is ");
    qdot_number_text_bound(out, w->ref_err);
    qdot_text_add(out, ";\nscd = -log10 err; time: CPU seconds of the integration, the "
                       "least and the median\n");
}

static qdot_status
rows_json(qdot_session *session, const void *study)
{
    const qdot_workprecision *w = study;

    for (size_t k = 0; k < w->n; k++) {
        qdot_text values = {0};
        double x[COLUMNS - 2];
        qdot_status status;

        numbers_of(w, &w->rows[k], x);
        qdot_text_json(&values, w->rows[k].method);
        for (size_t i = 0; i < COLUMNS - 2; i++) {
            if (!has_column(w, i + 1))
                continue;
            qdot_text_char(&values, ',');
            qdot_number_text_json(&values, x[i]);
        }
        qdot_text_char(&values, ',');
        qdot_text_json(&values, w->rows[k].status);
        status = qdot_answer_cells(session, &values);
        qdot_text_clear(&values);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* --- a figure ------------------------------------------------------------------------ */

static size_t
points_of(const void *study, qdot_error_point *points)
{
    const qdot_workprecision *w = study;

    for (size_t i = 0; i < w->n; i++)
        points[i] =
            (qdot_error_point){w->rows[i].method, w->rows[i].time_median, w->rows[i].err};
    return w->n;
}

static void
workprecision_note(const void *study, qdot_text *out)
{
    const qdot_workprecision *w = study;

    qdot_text_add(out, "medians of several runs; error of the reference ");
    qdot_number_text_bound(out, w->ref_err);
}

/* --- the statement ------------------------------------------------------------------- */

static qdot_status
workprecision_tell(qdot_session *session, const qdot_workprecision *w, const choices *chosen)
{
    const qdot_error_study of = {.name = "workprecision",
                                 .study = w,
                                 .left_out = &w->left_out,
                                 .interrupted = w->interrupted,
                                 .table = table,
                                 .csv = csv,
                                 .rows = rows_json,
                                 .figure = {.title = "work and precision",
                                            .abscissa = "CPU time in s",
                                            .ordinate = "error at the end",
                                            .none = "no method came to the end",
                                            .figure = &chosen->figure,
                                            .panel = &chosen->panel},
                                 .most_points = w->n,
                                 .points = points_of,
                                 .note = workprecision_note};

    return qdot_error_time_tell(session, &of);
}

/* A whole study is kept for reports (lang/files/report-work.h). */
static qdot_status
workprecision_keep(qdot_session *session, const qdot_run_request *request, qdot_workprecision *w)
{
    qdot_conditions conditions = {0};
    qdot_status status = qdot_conditions_take(session->scene, request, &conditions);

    if (status == QDOT_OK)
        status = qdot_studies_keep(&session->studies, &conditions, w);
    qdot_conditions_clear(&conditions);
    return status;
}

qdot_status
qdot_workprecision_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_session *session = c->session;
    qdot_request order = {0};
    qdot_workprecision w = {0};
    choices chosen = {0};
    qdot_expr from, to;
    qdot_status status;

    QDOT_TRY(qdot_read_range(c, &from, &to));
    QDOT_TRY(qdot_error_time_read(c, QDOT_FIGURE_OPTIONS, &chosen.figure, &chosen.panel));
    c->error_at = start->start;
    status = qdot_request_between(session, from, to, &order);
    if (status == QDOT_OK)
        status = qdot_workprecision_measure(session->scene, &order.request, &w);
    if (w.interrupted)
        qdot_interrupt_clear(); /* heard: the rows so far are told */
    if (status == QDOT_OK)
        status = workprecision_tell(session, &w, &chosen);
    if (status == QDOT_OK && w.interrupted)
        status = qdot_fail(QDOT_EINTR, "interrupted: there are %zu rows", w.n);
    if (status == QDOT_OK)
        status = workprecision_keep(session, &order.request, &w);
    status = qdot_request_explain(session, &order, status);
    qdot_workprecision_clear(&w);
    qdot_request_free(&order);
    return status;
}
