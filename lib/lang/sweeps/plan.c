/* plan.c -- the statement `plan`: tells how a run, or a sweep of many runs, would be computed. */
#include "base/memory.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/runs/request.h"
#include "lang/runs/run-options.h"
#include "lang/session/speeds.h"
#include "lang/sweeps/sweep-parts.h"
#include "lang/syntax/record.h"
#include "sim/run/run.h"

static qdot_status answer_plan(qdot_record *r);

QDOT_STATEMENT(plan) = {
    .word = "plan",
    .group = QDOT_NUMBERS,
    .usage = "plan [tol E] " QDOT_RUN_USAGE_OTHERS
             " | plan sweep " QDOT_MEMBERS_USAGE "EXPR, ... [as NAME] [threads N] [resume \"FILE.h5\"]",
    .summary = "how a run of this scene would be made, and why; or whether the runs of a sweep are made side by side or "
               "alone, and how long they take",
    .example = "plan",
    .handler = answer_plan,
};

/* Runs of q' and u' as first-order unknowns cost 0.6 to 5 times as much (doc/measurements.md). */
static qdot_status
describe_speeds(const qdot_session *session, qdot_text *text)
{
    qdot_speeds speeds;

    QDOT_TRY(qdot_session_speeds(session, &speeds));
    for (size_t k = 0; k < speeds.n; k++)
        qdot_text_format(text, "%s%s", k == 0 ? "speeds: " : ", ", qdot_expr_symbol(session->pool, speeds.symbol[k])->name);
    if (speeds.n > 0)
        qdot_text_add(text, ": for equations and answers; the run integrates the coordinates\n");
    qdot_free((void *)speeds.symbol);
    return qdot_text_status(text);
}

static qdot_status
answer_plan(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_run_options o = {.tol = 1e-12};
    qdot_request request = {0};
    qdot_text text = {0};
    qdot_status status;

    if (qdot_record_word(r, "sweep") != NULL)
        return qdot_sweep_plan(r);
    status = qdot_run_options_find(r, r->parts.at + 1, r->parts.at + r->parts.n, &o);
    if (status == QDOT_OK) {
        qdot_record_blame(r, r->parts.at);
        status = qdot_run_options_fill(session, &o, QDOT_ZERO, QDOT_ONE, &request);
    }
    if (status == QDOT_OK)
        status = qdot_run_plan(session->scene, &request.request, &text);
    if (status == QDOT_OK)
        status = describe_speeds(session, &text);
    status = qdot_answer_written(session, "plan", status, &text);
    qdot_request_free(&request);
    qdot_run_options_free(&o);
    return status;
}
