/* run.c -- the statement `run`: integrates the equations of motion, and keeps and reports the run. */
#include <string.h>

#include "base/interrupt.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/report.h"
#include "lang/runs/run.h"
#include "lang/commands/warnings.h"
#include "lang/session/runs.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_run(qdot_record *r);

QDOT_STATEMENT(run) = {
    .word = "run",
    .group = QDOT_NUMBERS,
    .usage = "run T0..T1 " QDOT_RUN_USAGE " [as NAME]",
    .summary = "integrate the equations of motion; reports steps, drift and error",
    .example = "run 0..20 tol 1e-12",
    .handler = carry_out_run,
};

/* Integrate the equations of motion, keep the run in the session, and report how it went. */
static qdot_status
integrate_and_report(qdot_cursor *c, const qdot_run_options *o, qdot_request *request)
{
    qdot_session *session = c->session;
    const qdot_run_report *report;
    qdot_run *run = NULL;
    qdot_status status;
    qdot_error error;
    char name[32];

    status = qdot_run_new(session->scene, &request->request, &run);
    error = *qdot_last_error();
    if (status == QDOT_OK && (status = qdot_pool_check(session->pool)) != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    if (run == NULL)
        return status;
    if (status == QDOT_EINTR)
        qdot_interrupt_clear(); /* the interruption is handled here: keep and report the run so far */
    if (o->name == NULL)
        qdot_runs_next_name(session, name, sizeof name);
    QDOT_TRY(qdot_runs_keep(session, o->name != NULL ? o->name : name,
                            qdot_text_str(&o->text), &request->request, run));
    report = qdot_run_get_report(run);
    if (!qdot_run_options_name_start(session->pool, o))
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
qdot_run_carry_out(qdot_cursor *c, const qdot_token *start, const qdot_run_options *o)
{
    qdot_request request = {0};
    qdot_status status = qdot_text_status(&o->text);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = qdot_run_options_fill(c->session, o, o->from, o->to, &request);
    }
    if (status == QDOT_OK)
        status = qdot_request_explain(c->session, &request, integrate_and_report(c, o, &request));
    qdot_run_options_place(c, o->method_at, status);
    qdot_request_free(&request);
    return status;
}

static qdot_status
carry_out_run(qdot_record *r)
{
    qdot_run_options o = {.tol = 1e-12};
    qdot_status status = qdot_run_options_find(r, r->parts.at + 1, r->parts.at + r->parts.n, &o);

    if (status == QDOT_OK)
        status = qdot_run_carry_out(&r->cursor, r->start, &o);
    else
        qdot_run_options_place(&r->cursor, o.method_at, status);
    qdot_run_options_free(&o);
    return status;
}
