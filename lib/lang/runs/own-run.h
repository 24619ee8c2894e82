/* own-run.h -- a run that a statement makes for itself: the latest one until it is dropped, under a
 * name that nobody can write.
 *
 * Tests  tests/script/sweeps/sweep.sh, sensitivity.sh, find.sh
 */
#ifndef QDOT_LANG_OWN_RUN_H
#define QDOT_LANG_OWN_RUN_H

#include "lang/runs/run-options.h"
#include "sim/run/run.h"

/* Make the run from..to of the values in force, with these options (NULL: those of a bare `run`). *run,
 * borrowed, and *end, its last time: NULL where not wanted. Drop it in any case. QDOT_EFAILED with the
 * reason: the run failed. */
QDOT_MUST_CHECK qdot_status qdot_own_run_make(qdot_session *session,
                                              const qdot_run_options *o, qdot_expr from,
                                              qdot_expr to, qdot_run **run,
                                              qdot_expr *end);
void qdot_own_run_drop(qdot_session *session);

/* The same with a run that somebody else has made, and keeps: until _take_back, which must follow.
 * QDOT_ENOMEM: the session has none. */
QDOT_MUST_CHECK qdot_status qdot_own_run_lend(qdot_session *session, const qdot_request *request,
                                              qdot_run *run);
void qdot_own_run_take_back(qdot_session *session);

/* Whether a failure does not depend on the values, so that the next run would fail, too. */
bool qdot_own_run_all_fail(qdot_status status);

/* The time of value(E, T), max(E, A..B), ... among the tokens from the cursor on that is farthest from the
 * start of the run; nil: none. */
qdot_expr qdot_own_run_needed(const qdot_cursor *c, qdot_expr from);

#endif
