/* workprecision.c -- the statement `workprecision`: error against CPU time of every method. */
#include <math.h>

#include "base/interrupt.h"
#include "base/number-text.h"
#include "lang/answer/table-answer.h"
#include "lang/figures/figure-option.h"
#include "lang/runs/error-time.h"
#include "lang/runs/request.h"
#include "lang/session/conditions.h"
#include "lang/syntax/record.h"
#include "sim/study/workprecision.h"

static qdot_status carry_out_workprecision(qdot_record *r);

QDOT_STATEMENT(workprecision) = {
    .word = "workprecision",
    .group = QDOT_NUMBERS,
    .usage = "workprecision T0..T1 " QDOT_FIGURE_USAGE,
    .summary = "error against time: every method over a ladder of tolerances",
    .example = "workprecision 0..20",
    .handler = carry_out_workprecision,
};

typedef struct {
    qdot_figure_choice figure;
    qdot_panel_choice panel;
} choices;

/* --- table of results ---------------------------------------------------------------- */

enum { EXCEPT_PEOPLE = QDOT_IN_ANSWERS | QDOT_IN_DATA };

static const qdot_table_column columns[] = {
    {.name = "method", .kind = QDOT_CELL_TEXT, .left = true, .width = 12},
    {.name = "tol", .form = QDOT_NUMBER_SCIENTIFIC, .width = 7, .exact = 1, .blank = true},
    {.name = "err", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 1, .width = 9, .blank = true},
    {.name = "scd", .form = QDOT_NUMBER_FIXED, .digits = 1, .width = 6, .blank = true},
    {.name = "time_min", .head = "time/s", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 2, .width = 10, .blank = true},
    {.name = "time_median", .head = "median", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 2, .width = 10, .blank = true},
    {.name = "evals", .form = QDOT_NUMBER_FIXED, .width = 9},
    {.name = "steps", .form = QDOT_NUMBER_FIXED, .width = 8},
    {.name = "rejected", .form = QDOT_NUMBER_FIXED, .width = 9},
    {.name = "energy_err", .head = "energy err", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 1, .width = 11,
     .blank = true},
    {.name = "constraint_err", .head = "constr. err", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 1, .width = 12,
     .blank = true},
    {.name = "ref_err", .in = EXCEPT_PEOPLE, .blank = true},
    {.name = "status", .kind = QDOT_CELL_TEXT, .left = true, .gap = 2}};

enum { COLUMNS = sizeof columns / sizeof *columns, CONSTRAINT_ERR = 10 };

/* Fill the table of results; the column of constraint errors only exists for scenes with constraints. */
static qdot_status
fill_study_table(const void *study, qdot_dataset *t)
{
    const qdot_workprecision *w = study;
    qdot_table_column some[COLUMNS];
    size_t n = 0;

    for (size_t i = 0; i < COLUMNS; i++)
        if (i != CONSTRAINT_ERR || w->constraints)
            some[n++] = columns[i];
    QDOT_TRY(qdot_table_begin(t, n, some));
    for (size_t k = 0; k < w->n; k++) {
        const qdot_workprecision_row *r = &w->rows[k];
        const double numbers[] = {r->tol,           r->err,          r->scd,
                                  r->time_min,      r->time_median,  (double)r->evals,
                                  (double)r->steps, (double)r->rejected, r->energy_err,
                                  r->constraint_err, w->ref_err};

        qdot_table_add_text(t, r->method);
        for (size_t i = 0; i < COLUMNS - 2; i++)
            if (i + 1 != CONSTRAINT_ERR || w->constraints)
                qdot_table_add_number(t, numbers[i], NAN);
        qdot_table_add_text(t, r->status);
    }
    return qdot_table_status(t);
}

static void
write_remarks(const void *study, qdot_text *out)
{
    const qdot_workprecision *w = study;

    qdot_text_add(out, "err: the largest error at the end, each relative to max(1, "
                       "|value|), against a reference whose own is ");
    qdot_number_text_bound(out, w->ref_err);
    qdot_text_add(out, ";\nscd = -log10 err; time: CPU seconds of the integration, the "
                       "least and the median\n");
}

static qdot_status
answer_rows_as_json(qdot_session *session, const void *study)
{
    qdot_dataset t = {0};
    qdot_status status = fill_study_table(study, &t);

    if (status == QDOT_OK)
        status = qdot_answer_rows(session, "workprecision", &t);
    qdot_table_clear(&t);
    return status;
}

/* --- figure of results --------------------------------------------------------------- */

static size_t
make_points(const void *study, qdot_error_point *points)
{
    const qdot_workprecision *w = study;

    for (size_t i = 0; i < w->n; i++)
        points[i] =
            (qdot_error_point){w->rows[i].method, w->rows[i].time_median, w->rows[i].err};
    return w->n;
}

static void
write_figure_note(const void *study, qdot_text *out)
{
    const qdot_workprecision *w = study;

    qdot_text_add(out, "medians of several runs; error of the reference ");
    qdot_number_text_bound(out, w->ref_err);
}

/* --- the statement `workprecision` --------------------------------------------------- */

static qdot_status
answer_workprecision(qdot_session *session, const qdot_workprecision *w, const choices *chosen)
{
    const qdot_error_study of = {.name = "workprecision",
                                 .study = w,
                                 .left_out = &w->left_out,
                                 .interrupted = w->interrupted,
                                 .table = fill_study_table,
                                 .words = write_remarks,
                                 .data = fill_study_table,
                                 .rows = answer_rows_as_json,
                                 .figure = {.title = "work and precision",
                                            .abscissa = "CPU time in s",
                                            .ordinate = "error at the end",
                                            .none = "no method reached the end",
                                            .figure = &chosen->figure,
                                            .panel = &chosen->panel},
                                 .most_points = w->n,
                                 .points = make_points,
                                 .note = write_figure_note};

    return qdot_error_time_tell(session, &of);
}

/* Store a complete work-precision study, for use in reports (lang/files/report-work.h). */
static qdot_status
store_study(qdot_session *session, const qdot_run_request *request, qdot_workprecision *w)
{
    qdot_conditions conditions = {0};
    qdot_status status = qdot_conditions_take(session->scene, request, &conditions);

    if (status == QDOT_OK)
        status = qdot_studies_keep(session->studies, &conditions, w);
    qdot_conditions_clear(&conditions);
    return status;
}

static qdot_status
carry_out_workprecision(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_request order = {0};
    qdot_workprecision w = {0};
    choices chosen = {0};
    qdot_expr from, to;
    qdot_status status;

    QDOT_TRY(qdot_record_range(r, r->parts.at + 1, &from, &to));
    QDOT_TRY(qdot_error_time_options(r, &chosen.figure, &chosen.panel));
    r->cursor.error_at = r->start->start;
    status = qdot_request_between(session, from, to, &order);
    if (status == QDOT_OK)
        status = qdot_workprecision_measure(session->scene, &order.request, &w);
    if (w.interrupted)
        qdot_interrupt_clear(); /* the interruption is handled here: report the rows measured so far */
    if (status == QDOT_OK)
        status = answer_workprecision(session, &w, &chosen);
    if (status == QDOT_OK && w.interrupted)
        status = qdot_fail(QDOT_EINTR, "interrupted: there are %zu rows", w.n);
    if (status == QDOT_OK)
        status = store_study(session, &order.request, &w);
    status = qdot_request_explain(session, &order, status);
    qdot_workprecision_clear(&w);
    qdot_request_free(&order);
    return status;
}
