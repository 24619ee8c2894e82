/* plot-again.c -- the statement `plot`: `for l = [1, 2]` makes the latest run once more for each value. */
#include <string.h>

#include "lang/figures/figure-option.h"
#include "lang/figures/plot.h"
#include "lang/runs/run-options.h"
#include "lang/session/runs.h"
#include "lang/source/source.h"
#include "lang/syntax/match.h"
#include "lang/syntax/statement.h"

static qdot_status draw_plot(qdot_record *r);

QDOT_STATEMENT(plot) = {
    .word = "plot",
    .group = QDOT_NUMBERS,
    .usage = "plot [EXPR [vs EXPR], \"DATA\" : T, EXPR, ... | EXPR, \"DATA\" : T, EXPR, ... vs NAME = A..B | ROWS | bode EXPR, ...] "
             "[for NAME = A..B, ...] " QDOT_FIGURE_USAGE
             " [| plot ...]",
    .summary = "a figure along the latest run, of an expression over a variable, of columns of a file, of a table of rows, or of "
               "magnitude and phase of a quotient in s; panels one below the other",
    .example = "plot theta' vs theta range -3..3 to \"fig.svg\"",
    .handler = draw_plot,
};

typedef struct {
    qdot_session *session;
    char *text;           /* limits and options of the latest run, "0..20 tol 1e-9"; owned */
    qdot_source *source;  /* `text` split into tokens */
    qdot_record record;   /* `text` parsed as the options of `run` */
    qdot_run_options run; /* the options with the present parameter values */
    qdot_trial trial;     /* the trial run that is made for the present pass of the loop */
} again;

/* Parse the text of the latest run's statement, in which names are those of the scene, not loop indices. */
static qdot_status
parse_run_statement(again *a)
{
    const qdot_cursor c = {.session = a->session, .source = a->source, .at = a->source->tokens.at};
    const size_t outer = qdot_names_enclose(a->session->names);
    const qdot_status status = qdot_match_operands(&c, qdot_statement_find("run"), &a->record);

    qdot_names_disclose(a->session->names, outer);
    return status;
}

/* Evaluate the options of the run statement with the present values of parameters. */
static qdot_status
evaluate_run_options(again *a)
{
    const size_t outer = qdot_names_enclose(a->session->names);
    qdot_record *r = &a->record;
    qdot_status status;

    qdot_run_options_free(&a->run);
    a->run = (qdot_run_options){.tol = 1e-12};
    status = qdot_run_options_find(r, r->parts.at + 1, r->parts.at + r->parts.n, &a->run);
    qdot_names_disclose(a->session->names, outer);
    return status;
}

/* Whether the statement of the latest run, carried out now, would make the same run again. */
static qdot_status
is_run_repeatable(again *a, const qdot_named_run *latest, bool *is)
{
    qdot_request request = {0};
    qdot_conditions now = {0};
    qdot_status status = qdot_run_options_fill(a->session, &a->run, a->run.from, a->run.to, &request);

    if (status == QDOT_OK)
        status = qdot_conditions_take(a->session->scene, &request.request, &now);
    *is = status == QDOT_OK && latest->conditions != NULL &&
          qdot_conditions_same(&now, latest->conditions);
    qdot_conditions_clear(&now);
    qdot_request_free(&request);
    return status;
}

static qdot_status
begin_repeating(void *user)
{
    again *a = user;
    qdot_named_run *latest;
    size_t at;
    bool is = false;

    QDOT_TRY(qdot_runs_find(a->session, NULL, &latest));
    a->text = qdot_strdup(latest->text);
    if (a->text == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_source_new("a run", a->text, strlen(a->text), &a->source, &at));
    if (parse_run_statement(a) == QDOT_OK && evaluate_run_options(a) == QDOT_OK)
        QDOT_TRY(is_run_repeatable(a, latest, &is));
    else
        QDOT_TRY(qdot_grave(qdot_last_error()->status)); /* if it fails, a name in the text is no longer declared */
    if (is)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the scene, its values or its start are no longer those of `%.200s`, so it cannot "
                                 "be made once more", latest->name);
    return qdot_hint("run %.100s", latest->text);
}

static qdot_status
repeat_run(void *user)
{
    again *a = user;

    QDOT_TRY(evaluate_run_options(a));
    QDOT_TRY(qdot_trial_begin(&a->trial, a->session));
    return qdot_run_options_try(&a->trial, &a->run, a->run.from, a->run.to);
}

static void
drop_repeated_run(void *user)
{
    qdot_trial_end(&((again *)user)->trial);
}

static qdot_status
draw_plot(qdot_record *r)
{
    again a = {.session = r->cursor.session};
    const qdot_plot_runs runs = {begin_repeating, repeat_run, drop_repeated_run, &a};
    const qdot_status status = qdot_plot_figure(r, &runs);

    qdot_run_options_free(&a.run);
    qdot_record_free(&a.record);
    qdot_source_free(a.source);
    qdot_free(a.text);
    return status;
}
