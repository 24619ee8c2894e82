/* trial.h -- a trial: other values, and perhaps a run with them, for the sake of one answer. After it all is as before.
 *
 *     qdot_trial t = {0};
 *     status = qdot_trial_begin(&t, session);         from now on the values may be changed:
 *     ... qdot_session_put(session, symbol, value)    by what `set` and `start` do
 *     ... qdot_trial_run(&t, request)                 makes a run; it is the session's latest one
 *     ... t.run, t.end, and numbers that are read of the latest run
 *     qdot_trial_end(&t);                             values, runs and numbers of runs are those before; in any case
 *
 * The request of a run of these values comes from lang/runs/run-options.h, whose qdot_run_options_try
 * makes it and the run.
 *
 * Tests  tests/script/sweeps/sweep.sh, tests/script/studies/sensitivity.sh, find.sh
 */
#ifndef QDOT_LANG_TRIAL_H
#define QDOT_LANG_TRIAL_H

#include "base/memory.h"
#include "lang/session/parts.h"
#include "sim/run/run.h"

typedef struct {
    qdot_session *session; /* borrowed; NULL: the trial has not begun, or has ended */
    qdot_run *run;         /* the trial's run, the latest one of the session until the trial ends; NULL: none was made */
    qdot_expr end;         /* the last time of the trial's run, exact */
    size_t measured;       /* how many numbers of runs the session had before the trial */
    bool lent;             /* the run belongs to somebody else, and is not freed with the trial */
    qdot_vec(qdot_expr) set_symbols, set_values, start_symbols, start_values; /* saved values */
} qdot_trial;

/* Begin a trial: save the values that `set` and `start` gave. QDOT_ENOMEM: there is no trial to be ended. */
QDOT_MUST_CHECK qdot_status qdot_trial_begin(qdot_trial *t, qdot_session *session);
/* Make the run that the request asks for: the latest one, under a name that nobody can write. QDOT_EFAILED
 * with its reason: the run failed. */
QDOT_MUST_CHECK qdot_status qdot_trial_run(qdot_trial *t, const qdot_run_request *request);
/* As qdot_trial_run, with a run that the caller has made and keeps. */
QDOT_MUST_CHECK qdot_status qdot_trial_lend(qdot_trial *t, const qdot_run_request *request, qdot_run *run);
/* End a trial: drop its run and the numbers read from it, and restore the saved values. */
void qdot_trial_end(qdot_trial *t);

/* Whether a failed trial fails for a reason independent of the values, so that other trials would fail, too. */
bool qdot_trial_all_fail(qdot_status status);

#endif
