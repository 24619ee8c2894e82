/* longtime.c -- the statement `longtime`: the energy error of every method over a long time. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "lang/answer/answer.h"
#include "lang/answer/table-answer.h"
#include "lang/figures/figure-option.h"
#include "lang/runs/error-time.h"
#include "lang/runs/request.h"
#include "lang/runs/run-options.h"
#include "lang/syntax/record.h"
#include "sim/study/longtime.h"

static qdot_status carry_out_longtime(qdot_record *r);

QDOT_STATEMENT(longtime) = {
    .word = "longtime",
    .group = QDOT_NUMBERS,
    .usage = "longtime T0..T1 [tol E] [method NAME] " QDOT_FIGURE_USAGE,
    .summary = "energy error against time, with its growth, by every method that fits or by one",
    .example = "longtime 0..1e4",
    .handler = carry_out_longtime,
};

typedef struct {
    qdot_figure_choice figure;
    qdot_panel_choice panel;
} choices;

/* --- tables and words --------------------------------------------------------------- */

/* Fill a table with the windows (parts of the time span) of methods k .. end - 1 and the rms error in each. */
static qdot_status
fill_windows(const qdot_longtime *l, size_t k, size_t end, qdot_dataset *t)
{
    static const qdot_table_column columns[] = {
        {.name = "method", .kind = QDOT_CELL_TEXT, .left = true},
        {.name = "tol", .form = QDOT_NUMBER_SCIENTIFIC, .exact = 1},
        {.name = "t", .digits = 6},
        {.name = "error", .form = QDOT_NUMBER_SCIENTIFIC_OR_0, .digits = 1}};

    QDOT_TRY(qdot_table_begin(t, sizeof columns / sizeof *columns, columns));
    for (; k < end; k++)
        for (size_t i = 0; i < l->rows[k].n; i++) {
            qdot_table_add_text(t, l->rows[k].method);
            qdot_table_add_number(t, l->rows[k].tol, 0);
            qdot_table_add_number(t, l->rows[k].t[i], NAN);
            qdot_table_add_number(t, l->rows[k].error[i], NAN);
        }
    return qdot_table_status(t);
}

static qdot_status
fill_all_windows(const void *study, qdot_dataset *t)
{
    const qdot_longtime *l = study;

    return fill_windows(l, 0, l->n, t);
}

/* Write into a table how the error grows, as a power of t: "t^1.00 +- 0.02". */
static void
write_growth(const qdot_longtime_row *r, qdot_dataset *t)
{
    qdot_text text = {0};

    if (isnan(r->growth))
        qdot_text_char(&text, '-');
    else
        qdot_text_format(&text, "t^%.2f +- %.2f", r->growth, r->growth_error);
    qdot_table_add_written(t, &text);
}

/* Fill the summary table of `longtime`, with one row for each method. */
static qdot_status
fill_summary(const void *study, qdot_dataset *t)
{
    static const qdot_table_column columns[] = {
        {.name = "method", .kind = QDOT_CELL_TEXT, .left = true, .width = 12},
        {.name = "tol", .form = QDOT_NUMBER_SCIENTIFIC, .width = 7},
        {.name = "steps", .form = QDOT_NUMBER_FIXED, .width = 10},
        {.name = "evals", .form = QDOT_NUMBER_FIXED, .width = 12},
        {.name = "time/s", .digits = 2, .width = 9},
        {.name = "error", .form = QDOT_NUMBER_SCIENTIFIC, .digits = 1, .width = 9},
        {.name = "growth", .kind = QDOT_CELL_TEXT, .width = 17},
        {.name = "status", .kind = QDOT_CELL_TEXT, .left = true, .gap = 2}};
    const qdot_longtime *l = study;

    QDOT_TRY(qdot_table_begin(t, sizeof columns / sizeof *columns, columns));
    for (size_t k = 0; k < l->n; k++) {
        const qdot_longtime_row *r = l->rows + k;

        qdot_table_add_text(t, r->method);
        qdot_table_add_number(t, r->tol, 0);
        qdot_table_add_number(t, (double)r->steps, 0);
        qdot_table_add_number(t, (double)r->evals, 0);
        qdot_table_add_number(t, r->cpu, NAN);
        qdot_table_add_number(t, r->largest, NAN);
        write_growth(r, t);
        qdot_table_add_text(t, r->status);
    }
    return qdot_table_status(t);
}

/* Write which method and tolerance the method `auto` would use, and why. */
static void
write_choice_of_auto(const qdot_longtime *l, qdot_text *out)
{
    qdot_text_format(out, "auto would take %s, tol %.0e: %s", l->chosen->name, l->chosen_tol,
                     l->chosen_long ? "more than 20000 steps are foreseen, and truncation is to "
                                      "stay below rounding"
                                    : l->chosen->fits);
}

static void
write_remarks(const void *study, qdot_text *out)
{
    const qdot_longtime *l = study;

    qdot_text_add(out, "error: the largest |E - E0| / max(1, |E0|) met; growth: of its root mean square in "
                       "windows of time,\nfitted to the later half of them, with twice the standard "
                       "error\n");
    if (l->chosen != NULL) {
        write_choice_of_auto(l, out);
        qdot_text_char(out, '\n');
    }
}

/* Answer the windows (parts of the time span) of a method as JSON rows, or the reason why the method failed. */
static qdot_status
answer_windows_as_json(qdot_session *session, const qdot_longtime *l, size_t k)
{
    const qdot_longtime_row *r = l->rows + k;
    qdot_dataset t = {0};
    qdot_status status = fill_windows(l, k, k + 1, &t);

    if (status == QDOT_OK)
        status = qdot_answer_rows(session, "longtime", &t);
    qdot_table_clear(&t);
    if (status == QDOT_OK && strcmp(r->status, "done") != 0)
        status = qdot_answer_notice(session, "method %s, tol %.0e: %s", r->method, r->tol, r->status);
    return status;
}

/* Answer the windows (parts of the time span) of each method, and the growth of its error, as JSON rows. */
static qdot_status
answer_rows_as_json(qdot_session *session, const void *study)
{
    const qdot_longtime *l = study;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < l->n && status == QDOT_OK; k++) {
        status = answer_windows_as_json(session, l, k);
        qdot_text_clear(&text);
        qdot_text_format(&text, "growth[%s]", l->rows[k].method);
        if (status == QDOT_OK)
            status = qdot_answer_number(session, qdot_text_str(&text), l->rows[k].growth,
                                        l->rows[k].growth_error);
    }
    qdot_text_clear(&text);
    if (status == QDOT_OK && l->chosen != NULL) {
        write_choice_of_auto(l, &text);
        status = qdot_answer_notice_text(session, status, &text);
    }
    return status;
}

static size_t
make_points(const void *study, qdot_error_point *points)
{
    const qdot_longtime *l = study;
    size_t n = 0;

    for (size_t k = 0; k < l->n; k++)
        for (size_t i = 0; i < l->rows[k].n; i++)
            points[n++] = (qdot_error_point){l->rows[k].method, l->rows[k].t[i], l->rows[k].error[i]};
    return n;
}

static void
write_figure_note(const void *study, qdot_text *out)
{
    (void)study;
    qdot_text_add(out, "root mean squares in windows of time");
}

static qdot_status
answer_longtime(qdot_session *session, const qdot_longtime *l, const choices *chosen)
{
    const qdot_error_study of = {.name = "longtime",
                                 .study = l,
                                 .left_out = &l->left_out,
                                 .interrupted = l->interrupted,
                                 .table = fill_summary,
                                 .words = write_remarks,
                                 .data = fill_all_windows,
                                 .rows = answer_rows_as_json,
                                 .figure = {.title = "error of the energy over long times",
                                            .abscissa = "time",
                                            .ordinate = "|E - E0| / max(1, |E0|)",
                                            .none = "no method got far enough",
                                            .figure = &chosen->figure,
                                            .panel = &chosen->panel},
                                 .most_points = l->n * QDOT_LONGTIME_WINDOWS,
                                 .points = make_points,
                                 .note = write_figure_note};

    return qdot_error_time_tell(session, &of);
}

/* --- the statement `longtime` ------------------------------------------------------- */

static qdot_status
carry_out_longtime(qdot_record *r)
{
    const qdot_filled *method = qdot_record_hole(r, "method", "NAME");
    qdot_session *session = r->cursor.session;
    qdot_request order = {0};
    qdot_longtime l = {0};
    choices chosen = {0};
    qdot_expr from, to;
    qdot_status status;

    QDOT_TRY(qdot_record_range(r, r->parts.at + 1, &from, &to));
    QDOT_TRY(qdot_error_time_tolerance(r, &l.tol));
    QDOT_TRY(qdot_error_time_options(r, &chosen.figure, &chosen.panel));
    r->cursor.error_at = r->start->start;
    l.method = method != NULL ? method->from->text : NULL;
    status = qdot_request_between(session, from, to, &order);
    if (status == QDOT_OK)
        status = qdot_longtime_measure(session->scene, &order.request, &l);
    if (l.interrupted)
        qdot_interrupt_clear(); /* the interruption is handled here: report the rows measured so far */
    if (status == QDOT_OK)
        status = answer_longtime(session, &l, &chosen);
    if (status == QDOT_OK && l.interrupted)
        status = qdot_fail(QDOT_EINTR, "interrupted: there are %zu methods", l.n);
    status = qdot_request_explain(session, &order, status);
    qdot_run_options_place(&r->cursor, method != NULL ? method->from : NULL, status);
    qdot_longtime_clear(&l);
    qdot_request_free(&order);
    return status;
}
