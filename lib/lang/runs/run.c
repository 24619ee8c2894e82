/* run.c -- the statements `run` and `plan`. */
#include <limits.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/report.h"
#include "lang/runs/request.h"
#include "lang/commands/set.h"
#include "lang/commands/statement.h"
#include "lang/commands/value-check.h"
#include "lang/commands/warnings.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/runs.h"
#include "tape/tape.h"

/* --- run ---------------------------------------------------------------------------- */

typedef struct {
    qdot_expr from, to;
    double tol;
    long digits; /* 0: doubles */
    const char *method, *name;
    const qdot_token *method_at;
    bool tol_given, treatment_given;
    qdot_run_treatment treatment;
    qdot_pairs with;
    qdot_text text; /* of the statement, without its name */
} options;

/* NAME = VALUE of a parameter or of a coordinate or velocity. */
static qdot_status
read_with(qdot_cursor *c, qdot_pairs *with)
{
    do {
        const qdot_token *start = c->at;
        qdot_cursor look = *c;
        qdot_expr symbol, value;
        const char *name;
        const qdot_name *known = NULL;

        if (c->at->kind == QDOT_TOKEN_NAME && qdot_read_name(&look, &name) == QDOT_OK)
            known = qdot_names_find(c->session->names, name);
        if (known != NULL && known->kind == QDOT_NAME_COORD)
            QDOT_TRY(qdot_set_read_jet(c, &symbol));
        else
            QDOT_TRY(qdot_set_read_parameter(c, &symbol));
        QDOT_TRY(qdot_set_read_constant(c, &value));
        c->error_at = start->start;
        QDOT_TRY(qdot_session_in_domain(c->session, symbol, value));
        QDOT_TRY(qdot_pairs_push(with, start, symbol, value));
    } while (qdot_cursor_accept_op(c, ","));
    return qdot_value_check(c, with);
}

static qdot_status
read_tolerance(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_cursor_once(c, "tol", o->tol_given));
    o->tol_given = true;
    QDOT_TRY(qdot_read_number(c, &o->tol));
    if (o->tol > 0 && o->tol < 1)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "a tolerance lies between 0 and 1");
}

/* project, baumgarte or none: how drift off the constraints is treated. */
static qdot_status
read_treatment(qdot_cursor *c, options *o)
{
    static const struct {
        const char *word;
        qdot_run_treatment treatment;
    } words[] = {{"project", QDOT_RUN_PROJECT},
                 {"baumgarte", QDOT_RUN_BAUMGARTE},
                 {"none", QDOT_RUN_NONE}};

    if (c->session->scene->constraints.n == 0) {
        c->error_at = c->at[-1].start;
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint NAME: A = B");
    }
    QDOT_TRY(qdot_cursor_once(c, "constraints", o->treatment_given));
    o->treatment_given = true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_cursor_accept_word(c, words[i].word)) {
            o->treatment = words[i].treatment;
            return QDOT_OK;
        }
    return qdot_cursor_expected(c, "`project`, `baumgarte` or `none`");
}

static qdot_status
read_digits(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at++;

    QDOT_TRY(qdot_cursor_once(c, "digits", o->digits != 0));
    QDOT_TRY(qdot_read_integer(c, &o->digits));
    c->error_at = start->start;
    if (o->digits >= 1 && o->digits <= INT_MAX)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "%ld digits cannot be asked for", o->digits);
    return qdot_hint("digits 30");
}

/* What the tokens [from, to) say, behind what was said before. */
static void
add_text(const qdot_cursor *c, const qdot_token *from, const qdot_token *to, options *o)
{
    if (from == to)
        return;
    if (o->text.n > 0)
        qdot_text_char(&o->text, ' ');
    qdot_token_text(c->session, from, to, &o->text);
}

/* start: the first token of the statement's operands. */
static qdot_status
read_options(qdot_cursor *c, const qdot_token *start, options *o)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "tol")) {
            QDOT_TRY(read_tolerance(c, o));
        } else if (qdot_cursor_is_word(c, "digits")) {
            QDOT_TRY(read_digits(c, o));
        } else if (qdot_cursor_accept_word(c, "method")) {
            QDOT_TRY(qdot_cursor_once(c, "method", o->method != NULL));
            if (c->at->kind != QDOT_TOKEN_NAME)
                return qdot_cursor_expected(c, "the name of a method");
            o->method_at = c->at;
            o->method = c->at++->text;
        } else if (qdot_cursor_accept_word(c, "constraints")) {
            QDOT_TRY(read_treatment(c, o));
        } else if (qdot_cursor_accept_word(c, "as")) {
            add_text(c, start, c->at - 1, o);
            QDOT_TRY(qdot_cursor_once(c, "as", o->name != NULL));
            QDOT_TRY(qdot_read_name(c, &o->name));
            start = c->at;
        } else if (qdot_cursor_accept_word(c, "with")) {
            QDOT_TRY(read_with(c, &o->with));
        } else {
            return qdot_cursor_expected(
                c, "`tol`, `digits`, `method`, `with`, `constraints` or `as`");
        }
    }
    add_text(c, start, c->at, o);
    if (o->tol_given && o->digits > 0) {
        c->error_at = c->at->start;
        qdot_fail(QDOT_EINVAL, "`digits` sets the tolerance itself: no `tol` beside it");
        return qdot_hint("digits %ld", o->digits);
    }
    return QDOT_OK;
}

/* The request is filled with the values of `with` in force, which then go again. */
static qdot_status
fill_with(qdot_session *session, const qdot_pairs *with, qdot_request *o)
{
    qdot_kept_values kept;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_session_keep_values(session, &kept));
    for (size_t i = 0; i < with->symbols.n && status == QDOT_OK; i++) {
        if (qdot_expr_is_class(session->pool, with->symbols.at[i], QDOT_COORD))
            status =
                qdot_session_start(session, with->symbols.at[i], with->values.at[i]);
        else
            qdot_session_set(session, with->symbols.at[i], with->values.at[i], &status);
    }
    if (status == QDOT_OK)
        status = qdot_request_fill(session, o);
    qdot_session_restore_values(session, &kept);
    return status;
}

/* Whether an initial value is among those of `with`. */
static bool
names_start(const qdot_session *session, const qdot_pairs *with)
{
    for (size_t i = 0; i < with->symbols.n; i++)
        if (qdot_expr_is_class(session->pool, with->symbols.at[i], QDOT_COORD))
            return true;
    return false;
}

/* Integrate, keep the run, tell how it went. */
static qdot_status
carry_out(qdot_cursor *c, const options *o, qdot_request *request)
{
    qdot_session *session = c->session;
    const qdot_run_report *report;
    qdot_run *run = NULL;
    qdot_status status;
    qdot_error error;
    char name[32];

    status = qdot_run_new(session->scene, &request->request, &run);
    error = *qdot_last_error();
    if (status == QDOT_OK)
        QDOT_TRY(qdot_pool_check(session->pool));
    if (run == NULL)
        return status;
    if (status == QDOT_EINTR)
        qdot_interrupt_clear(); /* heard: the run so far is kept and told */
    if (o->name == NULL)
        qdot_runs_next_name(session, name, sizeof name);
    QDOT_TRY(qdot_runs_keep(session, o->name != NULL ? o->name : name,
                            qdot_text_str(&o->text), &request->request, run));
    report = qdot_run_get_report(run);
    if (!names_start(session, &o->with))
        QDOT_TRY(qdot_warnings_start(session));
    for (const char *line = report->notice; line != NULL && *line != '\0';) {
        const char *behind = strchrnul(line, '\n');

        QDOT_TRY(qdot_answer_notice(session, "%.*s", (int)(behind - line), line));
        line = *behind == '\0' ? behind : behind + 1;
    }
    QDOT_TRY(qdot_report_run(session, o->name != NULL ? o->name : name, report));
    if (report->doubt != NULL && report->status != QDOT_RUN_FAILED)
        QDOT_TRY(qdot_answer_notice(session, "the error is unknown: %s", report->doubt));
    if (status != QDOT_OK)
        return qdot_fail_again(&error);
    if (report->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED, "the run failed: %s",
                         report->reason != NULL ? report->reason : "no reason is known");
    return QDOT_OK;
}

qdot_status
qdot_run_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    options o = {.tol = 1e-12};
    qdot_request request = {0};
    qdot_status status;

    status = qdot_read_range(c, &o.from, &o.to);
    if (status == QDOT_OK)
        status = read_options(c, start, &o);
    if (status == QDOT_OK)
        status = qdot_text_status(&o.text);
    if (status == QDOT_OK)
        c->error_at = start->start;
    if (status == QDOT_OK)
        status = fill_with(c->session, &o.with, &request);
    if (status == QDOT_OK) {
        request.request.tol = o.tol;
        request.request.digits = (int)o.digits;
        request.request.method = o.method != NULL ? o.method : "auto";
        request.request.treatment = o.treatment;
        status = qdot_request_limits(c->session, o.from, o.to, &request);
    }
    if (status == QDOT_OK)
        status = qdot_request_explain(c->session, &request, carry_out(c, &o, &request));
    if ((status == QDOT_ENAME || status == QDOT_ENOTBUILT) && o.method_at != NULL)
        c->error_at = o.method_at->start;
    qdot_text_clear(&o.text);
    qdot_request_free(&request);
    qdot_pairs_free(&o.with);
    return status;
}

/* The options of `run`; those that a plan does not depend on are refused. */
static qdot_status
read_plan_options(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(read_options(c, start, o));
    if (o->digits == 0 && o->name == NULL)
        return QDOT_OK;
    c->error_at = start->start;
    (void)qdot_fail(QDOT_EINVAL, o->name ? "a plan has no name" : "`digits` has no plan");
    return qdot_hint("plan tol 1e-9 method taylor");
}

qdot_status
qdot_run_plan_statement(qdot_cursor *c)
{
    options o = {.tol = 1e-12};
    const qdot_token *start = c->at - 1;
    qdot_request request = {0};
    qdot_text text = {0};
    qdot_status status = read_plan_options(c, &o);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = fill_with(c->session, &o.with, &request);
    }
    request.request.t0 = QDOT_ZERO;
    request.request.t1 = QDOT_ONE;
    request.request.tol = o.tol;
    request.request.method = o.method != NULL ? o.method : "auto";
    request.request.treatment = o.treatment;
    if (status == QDOT_OK)
        status = qdot_run_plan(c->session->scene, &request.request, &text);
    status = qdot_answer_written(c->session, "plan", status, &text);
    qdot_request_free(&request);
    qdot_text_clear(&o.text);
    qdot_pairs_free(&o.with);
    return status;
}
