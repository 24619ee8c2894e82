/* events.c -- the statement `events`: what occurred in the latest run, and when. */
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/session/event-time.h"
#include "lang/session/output.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_events(qdot_record *r);

QDOT_STATEMENT(events) = {
    .word = "events",
    .group = QDOT_NUMBERS,
    .usage = "events",
    .summary = "what occurred in the latest run, and when",
    .example = "events",
    .alone = true,
    .handler = carry_out_events,
};

/* If there is no run: list the declared events. */
static qdot_status
list_declared_events(qdot_session *session)
{
    qdot_text scene = {0}, text = {0};
    qdot_status status = qdot_scene_print(session->scene, &scene);

    for (const char *line = qdot_text_str(&scene); status == QDOT_OK && *line != '\0';) {
        const char *end = strchrnul(line, '\n');

        if (strncmp(line, "event ", 6) == 0)
            qdot_text_add_n(&text, line, (size_t)(end - line) + (*end != '\0'));
        line = *end == '\0' ? end : end + 1;
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_text(session, "events",
                                  text.n > 0 ? qdot_text_str(&text)
                                             : "no event is declared");
    qdot_text_clear(&scene);
    qdot_text_clear(&text);
    return status;
}

/* Answer the times [n] of an event in JSON, with their unit. */
static qdot_status
answer_times(qdot_session *session, const char *event, size_t n, const double *times, const double *errors)
{
    qdot_status status;

    session->output->unit = qdot_units_on(session) ? "s" : NULL;
    status = qdot_answer_numbers(session, event, n, times, errors);
    session->output->unit = NULL;
    return status;
}

/* List in JSON: one object for each event, with all its times. */
static qdot_status
list_events_in_json(qdot_session *session, const qdot_run_occurrence *list, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        qdot_vec(double) times = {0}, errors = {0};
        qdot_status status = QDOT_OK;
        bool before = false;

        for (size_t k = 0; k < i; k++)
            before = before || strcmp(list[k].event, list[i].event) == 0;
        if (before)
            continue;
        for (size_t k = i; k < n && status == QDOT_OK; k++) {
            if (strcmp(list[k].event, list[i].event) != 0)
                continue;
            status = qdot_vec_push(&times, list[k].t);
            if (status == QDOT_OK)
                status = qdot_vec_push(&errors, list[k].error);
        }
        if (status == QDOT_OK)
            status = answer_times(session, list[i].event, times.n, times.at, errors.at);
        qdot_free(times.at);
        qdot_free(errors.at);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* List the times of events of a run made with the option `digits`, as strings. */
static qdot_status
list_events_with_digits(qdot_session *session, const qdot_run *run, const qdot_run_occurrence *list,
                        size_t n)
{
    for (size_t i = 0; i < n; i++) {
        qdot_expr all;
        bool before = false;

        for (size_t k = 0; k < i; k++)
            before = before || strcmp(list[k].event, list[i].event) == 0;
        if (before)
            continue;
        QDOT_TRY(qdot_event_time(session, NULL, list[i].event, 0, &all));
        QDOT_TRY(qdot_digits_answer(session, list[i].event, all,
                                    qdot_run_get_report(run)->digits));
    }
    return QDOT_OK;
}

/* Append a line such as "cross[2]  t = 3.1234 ± 2e-15  rising". */
static qdot_status
append_event_line(qdot_session *session, int digits, qdot_text *text, const qdot_run_occurrence *o,
                  size_t k)
{
    double error = o->error;

    qdot_text_format(text, "%s[%zu]  t = ", o->event, k);
    if (digits > 0)
        QDOT_TRY(qdot_digits_number(session, o->exact, digits, &error, text));
    else
        qdot_number_text_known(text, o->t, error);
    qdot_number_text_error(text, error);
    qdot_text_format(text, "%s  %s\n", qdot_units_on(session) ? " [s]" : "",
                     o->way > 0   ? "rising"
                     : o->way < 0 ? "falling"
                                  : "touching");
    return QDOT_OK;
}

/* Print "NAME  from t = A on its sides are equal within their errors: ..." for an event of unknown occurrence. */
static void
print_unknown_span(const qdot_run *run, const qdot_run_faded *faded, qdot_text *text)
{
    if (faded->touched) {
        const double half = fabs(faded->to - faded->from) / 2;

        qdot_text_format(text, "%s  at t = ", faded->event);
        qdot_number_text_known(text, faded->from + (faded->to - faded->from) / 2, half);
        qdot_number_text_error(text, half);
        qdot_text_add(text, " its sides touch within rounding: whether it occurs there is not known");
        return;
    }
    qdot_text_format(text, "%s  from t = %.4g ", faded->event, faded->from);
    if (faded->to == qdot_run_get_report(run)->t1)
        qdot_text_add(text, "on");
    else
        qdot_text_format(text, "to %.4g", faded->to);
    qdot_text_add(text, " its sides are equal within their errors: whether it occurs there is not known");
}

/* In JSON, give a notice for each time span in which it is unknown whether an event occurs; faded [n] lists them. */
static qdot_status
give_notice_of_unknown_spans(qdot_session *session, const qdot_run *run, const qdot_run_faded *faded, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text text = {0};

        print_unknown_span(run, &faded[i], &text);
        QDOT_TRY(qdot_answer_notice_text(session, QDOT_OK, &text));
    }
    return QDOT_OK;
}

/* Add a line for each stretch of time in which it is not known whether an event occurs, faded [n], and for each event
 * of which it is not known whether it occurs at the end of the run. */
static qdot_status
append_unknown_spans(qdot_run *run, const qdot_run_faded *faded, size_t n, qdot_text *text)
{
    const char *name = "";
    bool undecided;

    for (size_t k = 0; k < n; k++) {
        print_unknown_span(run, &faded[k], text);
        qdot_text_char(text, '\n');
    }
    for (size_t k = 0; name; k++) {
        bool told = false;

        QDOT_TRY(qdot_run_event_at_end(run, k, &name, &undecided));
        for (size_t i = 0; name && i < n; i++)
            told = told || strcmp(faded[i].event, name) == 0;
        if (undecided && !told)
            qdot_text_format(text,
                             "%s  at the end of the run its sides are equal within their errors: "
                             "whether it occurs there is not known\n",
                             name);
    }
    return QDOT_OK;
}

/* The number of occurrences of an event that have been listed so far. */
typedef struct {
    const char *event;
    size_t n;
} event_count;
typedef qdot_vec(event_count) event_counts;

/* Count one more occurrence of the event; *k: its number among the occurrences of that event. */
static qdot_status
count_occurrence(event_counts *counts, const char *event, size_t *k)
{
    for (size_t i = 0; i < counts->n; i++)
        if (strcmp(counts->at[i].event, event) == 0) {
            *k = ++counts->at[i].n;
            return QDOT_OK;
        }
    *k = 1;
    return qdot_vec_push(counts, ((event_count){event, 1}));
}

static qdot_status
carry_out_events(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_run_occurrence *list;
    qdot_named_run *run;
    qdot_text text = {0};
    event_counts counts = {0};
    const qdot_run_faded *faded;
    qdot_status status = QDOT_OK;
    size_t n, n_faded;

    if (session->runs->n == 0)
        return list_declared_events(session);
    QDOT_TRY(qdot_runs_find(session, NULL, &run));
    QDOT_TRY(qdot_run_occurrences(run->run, &list, &n));
    QDOT_TRY(qdot_run_faded_events(run->run, &faded, &n_faded));
    if (session->output->json)
        QDOT_TRY(give_notice_of_unknown_spans(session, run->run, faded, n_faded));
    if (session->output->json && n > 0)
        return qdot_run_get_report(run->run)->digits > 0
                   ? list_events_with_digits(session, run->run, list, n)
                   : list_events_in_json(session, list, n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        size_t k;

        status = count_occurrence(&counts, list[i].event, &k);
        if (status == QDOT_OK)
            status =
                append_event_line(session, qdot_event_digits(run->run, &list[i]), &text, &list[i], k);
    }
    qdot_free(counts.at);
    if (n == 0)
        qdot_text_format(&text, n_faded > 0 ? "no event is known to have occurred in %s\n" : "no event occurred in %s\n",
                         run->name);
    if (status == QDOT_OK)
        status = append_unknown_spans(run->run, faded, n_faded, &text);
    return qdot_answer_written(session, "events", status, &text);
}
