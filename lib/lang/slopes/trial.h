/* trial.h -- a run at given values of unknowns: numbers of it, and their slopes by these.
 *
 *     QDOT_TRY(qdot_trial_open(&t, u));       the values in force, the run made: it is the latest
 *     ... read expressions e [m] of its numbers: value(theta, 3) - 1, ...
 *     qdot_trial_numbers(&t, m, e, value, error)
 *     qdot_trial_slopes(&t, m, e, slope, slope_error)     by the variational equations (slopes.h)
 *     qdot_trial_close(&t);                   all as before; in any case
 *
 * `find` is made of such trials; `fit` of responses (sim/study/response.h), which read no numbers of the
 * session.
 *
 * Tests  tests/script/studies/find.sh
 */
#ifndef QDOT_LANG_TRIAL_H
#define QDOT_LANG_TRIAL_H

#include "lang/runs/run-options.h"
#include "lang/session/values.h"
#include "lang/slopes/slopes.h"

typedef struct {
    qdot_session *session; /* borrowed, as all that follows */
    size_t n;              /* unknowns */
    const qdot_slope_name
        *unknowns; /* [n] label and symbol of a parameter, q or q'; a FORMAL symbol that
                                        limits and times hold: one of the statement's own */
    const qdot_run_options *options; /* NULL: those of a bare `run` */
    qdot_expr from, to;              /* limits; they may hold unknowns */

    /* Fields that are set while the trial is open: */
    bool open;
    qdot_run *run; /* borrowed: the session's */
    qdot_expr end; /* its last time, exact */
    size_t first;  /* numbers measured before it */
    qdot_kept_values kept;
    qdot_slopes
        slopes; /* of which slopes.variation.scene, and the run of name qdot_slopes_run */
} qdot_trial;

/* Set exact values [n] as `set` and `start` do; QDOT_EDOMAIN: one lies outside its domain. */
QDOT_MUST_CHECK qdot_status qdot_trial_put(qdot_session *session, size_t n,
                                           const qdot_slope_name *unknowns,
                                           const qdot_expr *values);

/* Make the run for values [n]. Close it in any case. QDOT_EFAILED: the run failed; the error has its reason. */
QDOT_MUST_CHECK qdot_status qdot_trial_open(qdot_trial *t, const qdot_expr *values);
void qdot_trial_close(qdot_trial *t);

/* Replace moving symbols in *e by their values at the end of the run. QDOT_EINVAL: an event stopped the run. */
QDOT_MUST_CHECK qdot_status qdot_trial_at_end(qdot_session *session, qdot_expr *e);
/* Evaluate a moving expression e at a time, as a result of the run. */
QDOT_MUST_CHECK qdot_status qdot_trial_at_time(qdot_session *session, qdot_expr e,
                                               qdot_expr time, qdot_expr *number);

/* Evaluate expressions e [m] of run results as doubles, with their errors (NaN: unknown). */
QDOT_MUST_CHECK qdot_status qdot_trial_numbers(qdot_trial *t, size_t m,
                                               const qdot_expr *e, double *value,
                                               double *error);

/* Make the run with variational equations, as far as the results in e [m] need it (m = 0: to the end). */
QDOT_MUST_CHECK qdot_status qdot_trial_vary(qdot_trial *t, size_t m, const qdot_expr *e);
/* Make it, and the slopes [m x n] of e by the unknowns, with their errors (NULL: not wanted). Numbers of other
 * runs are constants. */
QDOT_MUST_CHECK qdot_status qdot_trial_slopes(qdot_trial *t, size_t m, const qdot_expr *e,
                                              double *slope, double *error);

#endif
