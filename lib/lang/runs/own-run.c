/* own-run.c -- makes, keeps and drops a run that a statement needs for itself. */
#include "lang/runs/own-run.h"

#include <math.h>
#include <string.h>

#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/range.h"
#include "lang/session/runs.h"

static const char run_name[] = "the run";

/* Store the run in the session, which then owns it. */
static qdot_status
own_run_keep(qdot_session *session, const qdot_request *request, qdot_run *made, qdot_run **run,
             qdot_expr *end)
{
    const qdot_run_report *report = qdot_run_get_report(made);

    QDOT_TRY(qdot_runs_keep(session, run_name, "", &request->request, made));
    if (run != NULL)
        *run = made;
    if (report->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED, "%s",
                         report->reason != NULL ? report->reason : "the run failed");
    if (end != NULL)
        *end = report->status == QDOT_RUN_DONE
                   ? request->request.t1
                   : qdot_measured_rational(session->pool, report->t1);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_own_run_make(qdot_session *session, const qdot_run_options *o, qdot_expr from,
                  qdot_expr to, qdot_run **run, qdot_expr *end)
{
    const qdot_run_options bare = {.tol = 1e-12};
    qdot_request request = {0};
    qdot_run *made = NULL;
    qdot_status status =
        qdot_run_options_fill(session, o != NULL ? o : &bare, from, to, &request);

    if (status == QDOT_OK)
        status = qdot_request_explain(
            session, &request, qdot_run_new(session->scene, &request.request, &made));
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (made != NULL && status == QDOT_OK)
        status = own_run_keep(session, &request, made, run, end);
    else
        qdot_run_free(made);
    qdot_request_free(&request);
    return status;
}

/* The statement's own run if it exists; NULL otherwise. */
static qdot_named_run *
find_own_run(qdot_session *session)
{
    qdot_named_run *latest = session->runs->at + session->runs->n - 1;

    return session->runs->n > 0 && strcmp(latest->name, run_name) == 0 ? latest : NULL;
}

void
qdot_own_run_drop(qdot_session *session)
{
    if (find_own_run(session) != NULL)
        qdot_named_run_release(&session->runs->at[--session->runs->n]);
}

qdot_status
qdot_own_run_lend(qdot_session *session, const qdot_request *request, qdot_run *run)
{
    QDOT_TRY(qdot_runs_keep(session, run_name, "", &request->request, NULL));
    find_own_run(session)->run = run;
    return QDOT_OK;
}

void
qdot_own_run_take_back(qdot_session *session)
{
    find_own_run(session)->run = NULL;
    qdot_own_run_drop(session);
}

/* --- the duration of the run --------------------------------------------------------------- */

/* Read a time, or the end of a range A..B, at the cursor; if it is farther from `from` than *t it
 * replaces *latest and *t. */
static void
read_time(qdot_cursor *c, double from, qdot_expr *latest, double *t)
{
    qdot_expr e = QDOT_NIL;
    double x;
    qdot_status status = qdot_read_side(c, &e);

    if (status == QDOT_OK && qdot_cursor_accept_op(c, ".."))
        status = qdot_read_side(c, &e);
    if (status == QDOT_OK && qdot_session_number(c->session, e, &x, NULL) == QDOT_OK &&
        fabs(x - from) > fabs(*t - from)) {
        *t = x;
        *latest = e;
    }
}

qdot_expr
qdot_own_run_needed(const qdot_cursor *c, qdot_expr from)
{
    qdot_expr latest = QDOT_NIL;
    double start = 0, t;

    if (qdot_session_number(c->session, from, &start, NULL) != QDOT_OK)
        start = 0; /* whoever makes the run says why */
    t = start;
    for (const qdot_token *at = c->at; at->kind != QDOT_TOKEN_END; at++) {
        const qdot_token *comma = NULL, *in = at + 2;

        if (at->kind != QDOT_TOKEN_NAME || !qdot_range_is_of_way(at->text) || !qdot_token_is(at + 1, "("))
            continue;
        for (int depth = 0; in->kind != QDOT_TOKEN_END && depth >= 0; in++) {
            comma = depth == 0 && qdot_token_is(in, ",") ? in : comma;
            depth += qdot_token_bracket(in);
        }
        if (comma != NULL) {
            qdot_cursor look = *c;

            look.at = comma + 1;
            read_time(&look, start, &latest, &t);
        }
    }
    return latest;
}

bool
qdot_own_run_all_fail(qdot_status status)
{
    return status == QDOT_ESYNTAX || status == QDOT_ENAME || status == QDOT_ETYPE
           || status == QDOT_ENOTBUILT || status == QDOT_EUNSET || status == QDOT_ENOMEM
           || status == QDOT_EINTR;
}
