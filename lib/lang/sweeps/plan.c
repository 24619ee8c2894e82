/* plan.c -- the statement `plan`: how a run, or a sweep, would be made. */
#include "lang/answer/answer.h"
#include "lang/commands/handlers.h"
#include "lang/runs/request.h"
#include "lang/runs/run-options.h"
#include "lang/sweeps/sweep-parts.h"
#include "sim/run/run.h"

/* The options of `run`; those that a plan does not depend on are refused. */
static qdot_status
read_plan_options(qdot_cursor *c, qdot_run_options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_run_options_read(c, start, o));
    if (o->digits == 0 && o->name == NULL)
        return QDOT_OK;
    c->error_at = start->start;
    (void)qdot_fail(QDOT_EINVAL, o->name ? "a plan has no name" : "`digits` has no plan");
    return qdot_hint("plan tol 1e-9 method taylor");
}

qdot_status
qdot_run_plan_statement(qdot_cursor *c)
{
    qdot_run_options o = {.tol = 1e-12};
    const qdot_token *start = c->at - 1;
    qdot_request request = {0};
    qdot_text text = {0};
    qdot_status status;

    if (qdot_cursor_accept_word(c, "sweep"))
        return qdot_sweep_plan(c);
    status = read_plan_options(c, &o);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = qdot_run_options_fill(c->session, &o, QDOT_ZERO, QDOT_ONE, &request);
    }
    if (status == QDOT_OK)
        status = qdot_run_plan(c->session->scene, &request.request, &text);
    status = qdot_answer_written(c->session, "plan", status, &text);
    qdot_request_free(&request);
    qdot_run_options_free(&o);
    return status;
}
