/* lyapunov.c -- the statement `lyapunov [spectrum] T0..T1`: Lyapunov exponents, with a figure of their convergence. */
#include <math.h>
#include <stdio.h>

#include "base/interrupt.h"
#include "lang/answer/answer.h"
#include "lang/figures/figure-option.h"
#include "lang/runs/data-file.h"
#include "lang/runs/error-time.h"
#include "lang/runs/request.h"
#include "lang/session/output.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"
#include "sim/study/exponents.h"

static qdot_status carry_out_lyapunov(qdot_record *r);

QDOT_STATEMENT(lyapunov) = {
    .word = "lyapunov",
    .group = QDOT_NUMBERS,
    .usage = "lyapunov [spectrum] T0..T1 [tol E] " QDOT_FIGURE_USAGE,
    .summary = "the largest Lyapunov exponent, or all of them, by the variational equations, with errors by blocks of "
               "time; `to` a figure or data: how they settled",
    .example = "lyapunov 0..1000",
    .handler = carry_out_lyapunov,
};

/* the default tolerance, the same as for the statement `run` */
static const double tol_default = 1e-12;

typedef struct {
    double tol; /* 0: no tolerance given */
    qdot_figure_choice figure;
    qdot_panel_choice panel;
} choices;

/* --- answers and figures ----------------------------------------------------------------- */

/* Write the name of exponent k: "lyapunov" if only the largest is computed, otherwise "lyapunov[k]". */
static void
write_exponent_name(const qdot_exponents *x, size_t k, char *name, size_t size)
{
    if (x->spectrum)
        snprintf(name, size, "lyapunov[%zu]", k + 1);
    else
        snprintf(name, size, "lyapunov");
}

static qdot_status
answer_exponents(qdot_session *session, const qdot_exponents *x)
{
    qdot_status status = QDOT_OK;

    session->output->unit = qdot_units_on(session) ? "1/s" : NULL;
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        char name[40];

        write_exponent_name(x, k, name, sizeof name);
        status = qdot_answer_number(session, name, x->value[k], x->error[k]);
    }
    session->output->unit = NULL;
    return status;
}

/* Write a row for each time t: the estimates of the exponents from the run up to t. */
static qdot_status
write_convergence(qdot_session *session, const qdot_exponents *x, const char *path)
{
    qdot_table_column *columns = qdot_calloc(x->n + 1, sizeof *columns);
    char(*names)[40] = qdot_calloc(x->n, sizeof *names);
    qdot_dataset t = {.n = x->n + 1, .rows = x->windows, .columns = columns};
    qdot_status status = columns && names ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        columns[0] = (qdot_table_column){.name = "t", .values = x->t};
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        write_exponent_name(x, k, names[k], sizeof names[k]);
        columns[k + 1] = (qdot_table_column){
            .name = names[k], .gap = 2, .values = x->course + k, .stride = x->n};
    }
    if (status == QDOT_OK)
        status = qdot_data_file_write(session, NULL, &t, path);
    qdot_free(names);
    qdot_free(columns);
    return status;
}

static qdot_status
make_figure(qdot_session *session, const qdot_exponents *x, const choices *chosen)
{
    qdot_error_point *points = qdot_calloc(x->n * x->windows + 1, sizeof *points);
    char(*names)[40] = qdot_calloc(x->n + 1, sizeof *names);
    qdot_text note = {0};
    qdot_error_time of = {.title = x->spectrum
                                       ? "Lyapunov exponents, up to a time"
                                       : "the largest Lyapunov exponent, up to a time",
                          .abscissa = "time",
                          .ordinate = "|lambda|",
                          .note = &note,
                          .none = "the run did not get far enough",
                          .points = points,
                          .figure = &chosen->figure,
                          .panel = &chosen->panel};
    qdot_status status = points && names ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        write_exponent_name(x, k, names[k], sizeof names[k]);
        for (size_t w = 0; w < x->windows; w++)
            points[of.n++] =
                (qdot_error_point){names[k], x->t[w], fabs(x->course[w * x->n + k])};
    }
    qdot_text_add(&note, "sums of the growth since the start, by the time");
    if (status == QDOT_OK)
        status = qdot_error_time_show(session, &of);
    qdot_text_clear(&note);
    qdot_free(names);
    qdot_free(points);
    return status;
}

/* Answer the exponents; write a figure or data to the named file, or show a figure at the prompt. */
static qdot_status
show_exponents(qdot_session *session, const qdot_exponents *x, const choices *chosen)
{
    const char *path = chosen->figure.path;

    QDOT_TRY(answer_exponents(session, x));
    if (path == NULL)
        return QDOT_OK;
    return qdot_data_file_is(path) ? write_convergence(session, x, path) : make_figure(session, x, chosen);
}

/* --- the statement `lyapunov` ---------------------------------------------------------------- */

static qdot_status
carry_out_lyapunov(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_request order = {0};
    qdot_exponents x = {.spectrum = qdot_record_word(r, "spectrum") != NULL};
    choices chosen = {0};
    qdot_expr from, to;
    qdot_status status;

    QDOT_TRY(qdot_record_range(r, qdot_record_hole(r, NULL, "T0..T1"), &from, &to));
    QDOT_TRY(qdot_error_time_tolerance(r, &chosen.tol));
    QDOT_TRY(qdot_error_time_options(r, &chosen.figure, &chosen.panel));
    r->cursor.error_at = r->start->start;
    status = qdot_request_between(session, from, to, &order);
    order.request.tol = chosen.tol > 0 ? chosen.tol : tol_default;
    order.request.method = "auto";
    if (status == QDOT_OK)
        status = qdot_exponents_find(session->scene, &order.request, &x);
    if (x.interrupted)
        qdot_interrupt_clear(); /* the interruption has been handled: what is known so far is reported */
    if (status == QDOT_OK)
        status = show_exponents(session, &x, &chosen);
    if (status == QDOT_OK && x.interrupted)
        status =
            qdot_fail(QDOT_EINTR, "interrupted: the exponents are those up to t = %.6g",
                      x.t[x.windows - 1]);
    status = qdot_request_explain(session, &order, status);
    qdot_exponents_clear(&x);
    qdot_request_free(&order);
    return status;
}
