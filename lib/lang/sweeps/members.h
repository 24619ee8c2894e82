/* members.h -- the runs of a sweep, one for each member.
 *
 *     NAME = A..B step H, ... run T0..T1 [options] :
 *
 * Each is the run that `run ... with NAME = VALUE` would make; whatever is read of it is read while it
 * is the latest run, with its values in force.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_MEMBERS_H
#define QDOT_LANG_MEMBERS_H

#include "lang/runs/run-options.h"
#include "lang/sweeps/sweep-axis.h"
#include "sim/run/run.h"

typedef struct {
    qdot_sweep_axes axes;
    qdot_run_options run;
} qdot_members;

/* The usage text of a sweep's parameters and run, which stand before its columns. */
#define QDOT_MEMBERS_USAGE QDOT_SWEEP_AXES " run T0..T1 " QDOT_RUN_USAGE " : "
/* Take the parameters and the run of a sweep from the statement. m starts as {.run.tol = 1e-12};
 * free it in any case. */
QDOT_MUST_CHECK qdot_status qdot_members_find(qdot_record *r, qdot_members *m);
void qdot_members_free(qdot_members *m);

/* Set the values of run (member) k of a sweep, also into swept [axes]; the caller saves and restores the session's. */
QDOT_MUST_CHECK qdot_status qdot_members_set(qdot_session *session, const qdot_members *m, size_t k,
                                             double *swept);

/* A function applied to a run (member) of a sweep; end: the last time of that run. */
typedef qdot_status (*qdot_member_use)(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user);

/* Make the run of member k and use it; swept [axes] out: its values. A run that failed is an error,
 * QDOT_EFAILED with its reason. */
QDOT_MUST_CHECK qdot_status qdot_members_run(qdot_cursor *c, const qdot_members *m, size_t k,
                                             double *swept, qdot_member_use use, void *user);
/* As qdot_members_run, for a run of no duration, which consists of its start only. */
QDOT_MUST_CHECK qdot_status qdot_members_begin(qdot_cursor *c, const qdot_members *m, size_t k,
                                               double *swept, qdot_member_use use, void *user);

#endif
