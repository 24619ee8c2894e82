/* runs.c -- the runs of a session by name; values at a time along one of them. */
#include "lang/session/runs.h"

#include <stdio.h>
#include <string.h>

#include "expr/constant.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/labels.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "tape/tape.h"

void
qdot_named_run_release(qdot_named_run *run)
{
    if (--*run->uses > 0)
        return;
    qdot_free(run->name);
    qdot_free(run->text);
    qdot_run_free(run->run);
    if (run->conditions != NULL)
        qdot_conditions_clear(run->conditions);
    qdot_free(run->conditions);
    qdot_free(run->uses);
}

size_t
qdot_runs_index(const qdot_session *session, const char *name)
{
    size_t i = 0;

    while (i < session->runs->n && strcmp(session->runs->at[i].name, name) != 0)
        i++;
    return i;
}

void
qdot_runs_drop(qdot_session *session, size_t i)
{
    qdot_run_list *runs = session->runs;
    qdot_named_run gone = runs->at[i];

    memmove(&runs->at[i], &runs->at[i + 1], (runs->n - i - 1) * sizeof gone);
    runs->n--;
    qdot_named_run_release(&gone);
}

qdot_status
qdot_runs_keep(qdot_session *session, const char *name, const char *text,
               const qdot_run_request *request, qdot_run *run)
{
    qdot_named_run named = {.name = qdot_strdup(name),
                            .text = qdot_strdup(text),
                            .run = run,
                            .version = qdot_held_version(session),
                            .conditions = qdot_calloc(1, sizeof *named.conditions),
                            .uses = qdot_malloc(sizeof *named.uses)};
    const size_t old = qdot_runs_index(session, name);
    qdot_status status = QDOT_ENOMEM;

    if (named.uses == NULL) {
        qdot_free(named.name);
        qdot_free(named.text);
        qdot_free(named.conditions);
        qdot_run_free(run);
        return QDOT_ENOMEM;
    }
    *named.uses = 1;
    if (named.name != NULL && named.text != NULL && named.conditions != NULL)
        status = qdot_conditions_take(session->scene, request, named.conditions);
    if (status != QDOT_OK) {
        qdot_named_run_release(&named);
        return status;
    }

    if (old < session->runs->n)
        qdot_runs_drop(session, old);
    status = qdot_vec_push(session->runs, named);
    if (status != QDOT_OK)
        qdot_named_run_release(&named);
    return status;
}

void
qdot_runs_next_name(const qdot_session *session, char *name, size_t size)
{
    size_t k = session->runs->n;

    do
        snprintf(name, size, "run%zu", ++k);
    while (qdot_runs_index(session, name) < session->runs->n);
}

static qdot_status
report_unknown_run(const qdot_session *session, const char *name)
{
    qdot_words words = {0};
    qdot_status status;

    for (size_t i = 0; i < session->runs->n; i++)
        (void)qdot_vec_push(&words, session->runs->at[i].name); /* if memory runs out the hint lacks this word */
    (void)qdot_fail(QDOT_ENAME, "there is no run `%s`", name);
    status = qdot_labels_hint(name, &words);
    qdot_free(words.at);
    return status;
}

qdot_status
qdot_runs_find(qdot_session *session, const char *name, qdot_named_run **run)
{
    size_t i;

    if (session->runs->n == 0) {
        (void)qdot_fail(QDOT_EINVAL, "there is no run yet");
        return qdot_hint("run 0..20");
    }
    i = name != NULL ? qdot_runs_index(session, name) : session->runs->n - 1;
    if (i == session->runs->n)
        return report_unknown_run(session, name);
    *run = &session->runs->at[i];
    return QDOT_OK;
}

/* The value that the run was made with: of a parameter, or of a coordinate at its start; nil: it is none
 * of the run's. */
static qdot_expr
value_in_run(const qdot_session *session, const qdot_conditions *c, qdot_expr symbol)
{
    for (size_t i = 0; i < c->symbols.n; i++)
        if (c->symbols.at[i] == symbol)
            return c->values.at[i];
    for (size_t i = 0; i < c->q0.n && i < session->scene->coordinates.n; i++)
        if (session->scene->coordinates.at[i] == symbol)
            return c->q0.at[i];
    return QDOT_NIL;
}

/* Write a symbol and its value as "l = 1". */
static qdot_status
append_assignment(const qdot_session *session, qdot_expr symbol, qdot_expr value, qdot_text *text)
{
    qdot_text_format(text, "%s = ", qdot_expr_symbol(session->pool, symbol)->name);
    QDOT_TRY(qdot_print(session->pool, value, QDOT_PLAIN, text));
    return qdot_text_status(text);
}

static qdot_status
report_other_loop_value(const qdot_session *session, const qdot_named_run *run, const qdot_held *held,
                        qdot_expr value)
{
    qdot_text own = {0}, loop = {0};
    qdot_status status = append_assignment(session, held->symbol, value, &own);

    if (status == QDOT_OK)
        status = append_assignment(session, held->symbol, held->value, &loop);
    if (status == QDOT_OK) {
        (void)qdot_fail(QDOT_EINVAL, "the run `%.200s` has %.100s, and this pass of the loop %.100s",
                        run->name, qdot_text_str(&own), qdot_text_str(&loop));
        status = qdot_hint("run %.200s with %.100s", run->text, qdot_text_str(&loop));
    }
    qdot_text_clear(&own);
    qdot_text_clear(&loop);
    return status;
}

qdot_status
qdot_runs_read(qdot_session *session, const char *name, qdot_named_run **run)
{
    const qdot_conditions *c;

    QDOT_TRY(qdot_runs_find(session, name, run));
    c = (*run)->conditions;
    for (size_t i = 0; c != NULL && i < session->evaluation->held.n; i++) {
        const qdot_held *held = &session->evaluation->held.at[i];
        const qdot_expr value = value_in_run(session, c, held->symbol);

        if (value != QDOT_NIL && value != qdot_session_bind(session, held->value))
            return report_other_loop_value(session, *run, held, value);
    }
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_runs_flatten(qdot_session *session, qdot_expr e, qdot_runs_columns *columns)
{
    qdot_pool *pool = session->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);

    e = qdot_momenta_to_velocities(session, qdot_measured_as_rationals(session, e));
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_is_scalar(pool, e))
        return qdot_vec_push(columns, e);
    if (kind != QDOT_VEC && kind != QDOT_LIST)
        return qdot_fail(QDOT_ETYPE, "only numbers and vectors have values along a run");
    for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++) {
        qdot_expr part = qdot_expr_arg(pool, e, i);

        if (!qdot_expr_is_scalar(pool, part))
            return qdot_fail(QDOT_ETYPE,
                             "only numbers and vectors have values along a run");
        QDOT_TRY(qdot_vec_push(columns, part));
    }
    return QDOT_OK;
}

/* Evaluate columns at a time: each result is a number with its error, m [columns]. */
static qdot_status
evaluate_columns_at(qdot_session *session, qdot_run *run, const qdot_runs_columns *columns,
                    qdot_expr time, qdot_measured *m)
{
    const size_t n = columns->n;
    double t, low, *values = qdot_calloc(2 * n, sizeof *values);
    qdot_status status = values == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK)
        status = qdot_session_split(session, time, &t, &low);
    if (status == QDOT_OK)
        status = qdot_run_values_beyond(run, n, columns->at, &(qdot_exact_times){1, &t, &low}, values,
                                        values + n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        m[i] = (qdot_measured){.value = values[i], .error = values[n + i]};
    qdot_free(values);
    return status;
}

/* As evaluate_columns_at, for a run made with the option `digits`, at an exact time. */
static qdot_status
evaluate_columns_exactly(qdot_session *session, qdot_run *run, const qdot_runs_columns *columns,
                         qdot_expr time, qdot_measured *m)
{
    const size_t n = columns->n;
    const int digits = qdot_run_get_report(run)->digits;
    double *errors = qdot_calloc(n, sizeof *errors);
    qdot_expr *exact = qdot_calloc(n, sizeof *exact);
    qdot_status status = errors == NULL || exact == NULL ? QDOT_ENOMEM : QDOT_OK;

    time = qdot_measured_as_rationals(session, qdot_session_bind(session, time));
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = qdot_run_exact_values(run, n, columns->at, time, exact, errors);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        m[i] = (qdot_measured){.error = errors[i], .digits = digits, .exact = exact[i]};
        status = qdot_constant_double(session->pool, exact[i], &m[i].value);
    }
    qdot_free(errors);
    qdot_free(exact);
    return status;
}

qdot_status
qdot_runs_measure(qdot_session *session, const char *run,
                  const qdot_runs_columns *columns, qdot_expr time, qdot_measured *m)
{
    qdot_named_run *named = NULL;

    QDOT_TRY(qdot_runs_find(session, run, &named));
    return qdot_run_get_report(named->run)->digits > 0
               ? evaluate_columns_exactly(session, named->run, columns, time, m)
               : evaluate_columns_at(session, named->run, columns, time, m);
}

qdot_status
qdot_runs_measure_one(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                      qdot_measured *m)
{
    return qdot_runs_measure(session, run, &(qdot_runs_columns){.at = &e, .n = 1}, time,
                             m);
}

bool
qdot_runs_is_family(const qdot_session *session, const char *name)
{
    for (size_t i = 0; i < session->runs->n; i++)
        if (qdot_is_member_of(session->runs->at[i].name, name))
            return true;
    return false;
}
