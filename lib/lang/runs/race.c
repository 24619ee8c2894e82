/* race.c -- the statement `race`, which compares formulations of a scene: a table, and a figure of error against time. */
#include <math.h>

#include "base/interrupt.h"
#include "base/number-text.h"
#include "lang/answer/answer.h"
#include "lang/answer/table-answer.h"
#include "lang/figures/figure-option.h"
#include "lang/runs/error-time.h"
#include "lang/runs/request.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"
#include "sim/study/race.h"

static qdot_status carry_out_race(qdot_record *r);

QDOT_STATEMENT(race) = {
    .word = "race",
    .group = QDOT_NUMBERS,
    .usage = "race T0..T1 " QDOT_FIGURE_USAGE,
    .summary = "one scene as given (projected, Baumgarte, none) and in minimal coordinates: errors, "
               "drifts and times at a ladder of tolerances, and their figure",
    .example = "race 0..20",
    .handler = carry_out_race,
};

/* Fill the table of a race, with columns formulation, method, tolerance, error, drifts, CPU seconds. */
static qdot_status
fill_race_table(const qdot_race *race, qdot_dataset *t)
{
    static const qdot_table_column columns[] = {
        {.name = "formulation", .kind = QDOT_CELL_TEXT, .left = true, .width = 20},
        {.name = "method", .kind = QDOT_CELL_TEXT, .left = true, .gap = 2, .width = 7},
        {.name = "tol", .form = QDOT_NUMBER_SCIENTIFIC, .gap = 2, .width = 5},
        {.name = "error", .form = QDOT_NUMBER_SCIENTIFIC_OR_0, .digits = 1, .width = 9},
        {.name = "energy", .form = QDOT_NUMBER_SCIENTIFIC_OR_0, .digits = 1, .width = 9},
        {.name = "constraints", .form = QDOT_NUMBER_SCIENTIFIC_OR_0, .digits = 1, .width = 12},
        {.name = "cpu ms", .in = QDOT_IN_TERMINAL, .digits = 3, .gap = 2, .width = 10},
        {.name = "cpu", .in = QDOT_IN_ANSWERS}};

    QDOT_TRY(qdot_table_begin(t, sizeof columns / sizeof *columns, columns));
    for (int i = 0; i < QDOT_RACE_FORMULATIONS; i++)
        for (int k = 0; race->lane[i].name != NULL && k < QDOT_RACE_TOLERANCES; k++) {
            const qdot_race_entry *e = &race->lane[i].entry[k];
            const double numbers[] = {e->tol, e->error, e->energy, e->constraint, 1e3 * e->cpu, e->cpu};

            if (e->method == NULL)
                continue;
            qdot_table_add_text(t, race->lane[i].name);
            qdot_table_add_text(t, e->method);
            for (size_t j = 0; j < sizeof numbers / sizeof *numbers; j++)
                qdot_table_add_number(t, numbers[j], NAN);
        }
    return qdot_table_status(t);
}

/* Append the words about a race, with its table between them unless t is NULL. */
static qdot_status
print_race(const qdot_race *race, const qdot_dataset *t, qdot_text *out)
{
    qdot_text_format(out,
                     "race: end errors against the scene as given, projected, at tol %.0e, "
                     "its own error about ",
                     race->reference_tol);
    qdot_number_text_bound(out, race->reference_error);
    if (race->minimal > 0)
        qdot_text_format(out, "\n%zu coordinates as given, %zu in minimal coordinates",
                         race->coordinates, race->minimal);
    qdot_text_char(out, '\n');
    if (t != NULL)
        QDOT_TRY(qdot_answer_add_table(t, out));
    for (int i = 0; i < QDOT_RACE_FORMULATIONS; i++)
        if (race->lane[i].reason != NULL)
            qdot_text_format(out, "not in %s: %s\n",
                             i + 1 < QDOT_RACE_FORMULATIONS ? "this treatment"
                                                            : "minimal coordinates",
                             race->lane[i].reason);
    QDOT_TRY(qdot_text_status(out));
    qdot_text_truncate(out, out->n - 1); /* remove the final newline */
    return QDOT_OK;
}

static qdot_status
draw_race(qdot_session *session, const qdot_race *race, const qdot_figure_choice *choice,
          const qdot_panel_choice *of_panel)
{
    qdot_error_point points[QDOT_RACE_FORMULATIONS * QDOT_RACE_TOLERANCES];
    qdot_text note = {0};
    qdot_error_time of = {.title = "one scene in every formulation",
                          .abscissa = "CPU time in s",
                          .ordinate = "error at the end",
                          .note = &note,
                          .none = "no formulation of the race reached the end",
                          .points = points,
                          .figure = choice,
                          .panel = of_panel};
    qdot_status status;

    for (int i = 0; i < QDOT_RACE_FORMULATIONS; i++)
        for (int k = 0; race->lane[i].name != NULL && k < QDOT_RACE_TOLERANCES; k++) {
            const qdot_race_entry *e = &race->lane[i].entry[k];

            points[of.n++] = (qdot_error_point){race->lane[i].name, e->cpu, e->error};
        }
    qdot_text_format(&note, "reference: as given, projected, tol %.0e, its own error ",
                     race->reference_tol);
    qdot_number_text_bound(&note, race->reference_error);
    status = qdot_error_time_show(session, &of);
    qdot_text_clear(&note);
    return status;
}

static qdot_status
answer_race(qdot_session *session, const qdot_race *race, const qdot_figure_choice *figure,
            const qdot_panel_choice *panel)
{
    qdot_text text = {0};
    qdot_dataset t = {0};
    qdot_status status = fill_race_table(race, &t);

    if (status == QDOT_OK && race->notice != NULL)
        status = qdot_answer_notice(session, "%s", race->notice);
    if (status == QDOT_OK)
        status = print_race(race, session->output->display ? NULL : &t, &text); /* rows are shown as a table */
    if (status == QDOT_OK)
        status = qdot_answer_text(session, "race", qdot_text_str(&text));
    if (status == QDOT_OK && session->output->json)
        status = qdot_answer_rows(session, "race", &t);
    qdot_text_clear(&text);
    qdot_table_clear(&t);
    /* after an interruption draw the figure only if the user asked for a file */
    if (status == QDOT_OK && (!race->interrupted || figure->path != NULL))
        status = draw_race(session, race, figure, panel);
    return status;
}

static qdot_status
carry_out_race(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_request order = {0};
    qdot_expr from, to;
    qdot_figure_choice figure = {0};
    qdot_panel_choice panel = {0};
    qdot_race race;
    qdot_status status;

    QDOT_TRY(qdot_record_range(r, r->parts.at + 1, &from, &to));
    QDOT_TRY(qdot_figure_option_find(r, r->parts.at, r->parts.at + r->parts.n, &figure, &panel));
    QDOT_TRY(qdot_figure_option_no_angles(r, &panel));
    r->cursor.error_at = r->start->start;
    status = qdot_request_between(session, from, to, &order);
    order.request.method = "auto";
    order.request.tol = 1e-12;
    if (status == QDOT_OK) {
        status = qdot_race_hold(session->scene, &order.request, &race);
        if (status == QDOT_OK) {
            if (race.interrupted)
                qdot_interrupt_clear(); /* the interruption is handled here: report the rows measured so far */
            status = answer_race(session, &race, &figure, &panel);
            if (status == QDOT_OK && race.interrupted)
                status = qdot_fail(QDOT_EINTR, "interrupted: the race has the rows above");
            qdot_race_clear(&race);
        }
    }
    status = qdot_request_explain(session, &order, status);
    qdot_request_free(&order);
    return status;
}
