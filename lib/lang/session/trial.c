/* trial.c -- a trial: sets other values temporarily, and makes a run with them, to compute one answer. */
#include "lang/session/trial.h"

#include <string.h>

#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/session/values.h"

static const char run_name[] = "the run";

#define EACH_LIST(X) X(set_symbols) X(set_values) X(start_symbols) X(start_values)

qdot_status
qdot_trial_begin(qdot_trial *t, qdot_session *session)
{
    const qdot_values *values = session->values;
    qdot_status status = QDOT_OK;

    *t = (qdot_trial){.measured = session->measured->n};
#define X(list)                                                                          \
    for (size_t i = 0; i < values->list.n && status == QDOT_OK; i++)                     \
        status = qdot_vec_push(&t->list, values->list.at[i]);
    EACH_LIST(X)
#undef X
    if (status == QDOT_OK) {
        t->session = session;
        return QDOT_OK;
    }
#define X(list) qdot_free(t->list.at);
    EACH_LIST(X)
#undef X
    return status;
}

/* --- the run ------------------------------------------------------------------------------ */

/* Whether the latest run of the session was made for a trial. */
static bool
is_trial_run_latest(const qdot_session *session)
{
    return session->runs->n > 0 && strcmp(session->runs->at[session->runs->n - 1].name, run_name) == 0;
}

/* Store the run in the session, which then owns it. */
static qdot_status
store_trial_run(qdot_trial *t, const qdot_run_request *request, qdot_run *run)
{
    const qdot_run_report *report = qdot_run_get_report(run);

    QDOT_TRY(qdot_runs_keep(t->session, run_name, "", request, run));
    t->run = run;
    if (report->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED, "%s", report->reason != NULL ? report->reason : "the run failed");
    t->end = report->status == QDOT_RUN_DONE ? request->t1
                                             : qdot_measured_rational(t->session->pool, report->t1);
    return qdot_pool_check(t->session->pool);
}

qdot_status
qdot_trial_run(qdot_trial *t, const qdot_run_request *request)
{
    qdot_run *run = NULL;
    qdot_status status = qdot_run_new(t->session->scene, request, &run);

    if (status == QDOT_OK)
        status = qdot_pool_check(t->session->pool);
    if (run != NULL && status == QDOT_OK)
        return store_trial_run(t, request, run);
    qdot_run_free(run);
    return status;
}

qdot_status
qdot_trial_lend(qdot_trial *t, const qdot_run_request *request, qdot_run *run)
{
    QDOT_TRY(qdot_runs_keep(t->session, run_name, "", request, NULL));
    t->session->runs->at[t->session->runs->n - 1].run = run;
    t->run = run;
    t->lent = true;
    return QDOT_OK;
}

static void
drop_trial_run(qdot_trial *t)
{
    qdot_run_list *runs = t->session->runs;

    if (is_trial_run_latest(t->session)) {
        if (t->lent)
            runs->at[runs->n - 1].run = NULL;
        qdot_named_run_release(&runs->at[--runs->n]);
    }
    t->session->measured->n = t->measured;
}

/* --- the end ------------------------------------------------------------------------------ */

void
qdot_trial_end(qdot_trial *t)
{
    if (t->session == NULL)
        return;
    if (t->run != NULL)
        drop_trial_run(t);
#define X(list)                                                                          \
    qdot_free(t->session->values->list.at);                                              \
    memcpy(&t->session->values->list, &t->list, sizeof t->list);
    EACH_LIST(X)
#undef X
    *t = (qdot_trial){0};
}

bool
qdot_trial_all_fail(qdot_status status)
{
    return status == QDOT_ESYNTAX || status == QDOT_ENAME || status == QDOT_ETYPE
           || status == QDOT_ENOTBUILT || status == QDOT_EUNSET || status == QDOT_ENOMEM
           || status == QDOT_EINTR;
}
