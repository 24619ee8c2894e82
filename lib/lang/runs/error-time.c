/* error-time.c -- the figure of `race`, `workprecision` and `longtime`: error against time. */
#include "lang/runs/error-time.h"

#include <math.h>
#include <string.h>

#include "base/wrap.h"
#include "lang/answer/answer.h"
#include "lang/figures/figure-file.h"
#include "lang/runs/data-file.h"
#include "lang/session/output.h"
#include "show/figure.h"
#include "table/text.h"

/* an error of 0 has no logarithm: on a logarithmic axis it is drawn as this, far below rounding errors */
static const double least_error = 0x1p-60;

/* Make the curves of the figure from their points x, y [n each]; returns the number of curves. */
static size_t
fill_curves(const qdot_error_time *of, double *x, double *y, qdot_curve *curves)
{
    size_t n = 0, at = 0;

    for (size_t i = 0; i < of->n; i++) {
        const qdot_error_point *p = of->points + i;

        if (!isfinite(p->error) || !(p->time > 0))
            continue;
        if (n == 0 || strcmp(curves[n - 1].label.text, p->name) != 0)
            curves[n++] = (qdot_curve){.label = {p->name, false}, .x = x + at, .y = y + at};
        x[at] = p->time;
        y[at++] = fmax(p->error, least_error);
        curves[n - 1].rows++;
    }
    return n;
}

qdot_status
qdot_error_time_show(qdot_session *session, const qdot_error_time *of)
{
    qdot_curve *curves = qdot_calloc(of->n + 1, sizeof *curves);
    double *values = qdot_calloc(2 * of->n + 1, sizeof *values);
    qdot_panel panel = {.title = {of->title, false},
                        .note = qdot_text_str(of->note),
                        .axis = {{of->abscissa, false}, {of->ordinate, false}},
                        .curves = curves,
                        .log = {true, true},
                        .marks = true};
    const qdot_figure figure = {.panels = &panel,
                                .n = 1,
                                .width = of->figure->width,
                                .height = of->figure->height,
                                .keep = of->figure->keep};
    qdot_status status = curves && values ? qdot_text_status(of->note) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        panel.n = fill_curves(of, values, values + of->n, curves);
        if (panel.n == 0)
            status = qdot_fail(QDOT_EFAILED, "%s", of->none);
    }
    if (status == QDOT_OK)
        status = qdot_figure_option_apply(NULL, of->panel, &panel);
    if (status == QDOT_OK)
        status = qdot_figure_file_show(session, &figure, of->figure->path);
    qdot_free(curves);
    qdot_free(values);
    return status;
}

qdot_status
qdot_error_time_options(qdot_record *r, qdot_figure_choice *figure, qdot_panel_choice *panel)
{
    QDOT_TRY(qdot_figure_option_find(r, r->parts.at, r->parts.at + r->parts.n, figure, panel));
    QDOT_TRY(qdot_figure_option_no_angles(r, panel));
    if (figure->path == NULL || qdot_data_file_is(figure->path) || qdot_figure_is_file(figure->path))
        return QDOT_OK;
    qdot_record_blame(r, qdot_record_hole(r, NULL, "T0..T1") + 1);
    (void)qdot_fail(QDOT_EINVAL, "the name `%.200s` does not tell the kind of file", figure->path);
    return qdot_hint("end its name in .csv, .txt, .json, .html, .h5, .svg, .png, .pdf, .eps or .tikz");
}

qdot_status
qdot_error_time_tolerance(qdot_record *r, double *tol)
{
    const qdot_filled *part = qdot_record_hole(r, "tol", "E");

    *tol = 0;
    if (part == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_number(r, part, tol));
    qdot_record_blame(r, part);
    return *tol >= 1e-16 && *tol < 1 ? QDOT_OK
                                     : qdot_fail(QDOT_EINVAL, "a tolerance lies between 1e-16 and 1");
}

static qdot_status
give_notice_of_methods_left_out(qdot_session *session, const qdot_methods_left_out *list)
{
    for (size_t i = 0; i < list->n; i++)
        QDOT_TRY(qdot_answer_notice(session, "method %s is left out: %s", list->at[i].method,
                                    list->at[i].reason));
    return QDOT_OK;
}

/* Append the table of errors and the words below it; mark: text before table cells (table/text.h). */
static qdot_status
write_table(const qdot_error_study *of, const char *mark, qdot_text *out)
{
    const qdot_table_text_options options = {QDOT_IN_TERMINAL, 0, mark};
    qdot_dataset t = {0};
    qdot_status status = of->table(of->study, &t);

    if (status == QDOT_OK)
        status = qdot_table_text(&t, &options, out);
    qdot_table_clear(&t);
    of->words(of->study, out);
    return status;
}

static qdot_status
answer_table(qdot_session *session, const qdot_error_study *of)
{
    qdot_text text = {0};
    qdot_status status;

    if (session->output->json)
        return of->rows(session, of->study);
    status = write_table(of, QDOT_WRAP_CELL, &text);
    return qdot_answer_written(session, of->name, status, &text);
}

static qdot_status
write_file(qdot_session *session, const qdot_error_study *of, const char *path)
{
    qdot_text text = {0};
    qdot_dataset t = {0};
    qdot_status status;

    if (!qdot_ends_in(path, ".txt")) {
        status = of->data(of->study, &t);
        if (status == QDOT_OK)
            status = qdot_data_file_write(session, NULL, &t, path);
        qdot_table_clear(&t);
        return status;
    }
    status = write_table(of, "", &text);
    if (status == QDOT_OK)
        status = qdot_answer_in_file(session, path, &text);
    qdot_text_clear(&text);
    return status;
}

static qdot_status
show_figure(qdot_session *session, const qdot_error_study *of)
{
    qdot_error_point *points = qdot_calloc(of->most_points + 1, sizeof *points);
    qdot_text note = {0};
    qdot_error_time figure = of->figure;
    qdot_status status;

    if (points == NULL)
        return QDOT_ENOMEM;
    figure.points = points;
    figure.note = &note;
    figure.n = of->points(of->study, points);
    of->note(of->study, &note);
    status = qdot_error_time_show(session, &figure);
    qdot_text_clear(&note);
    qdot_free(points);
    return status;
}

qdot_status
qdot_error_time_tell(qdot_session *session, const qdot_error_study *of)
{
    const char *path = of->figure.figure->path;

    QDOT_TRY(give_notice_of_methods_left_out(session, of->left_out));
    if (path != NULL && qdot_data_file_is(path))
        return write_file(session, of, path);
    QDOT_TRY(answer_table(session, of));
    if (of->interrupted && path == NULL)
        return QDOT_OK; /* no figure after an interruption, as the user does not want to wait */
    return show_figure(session, of);
}
