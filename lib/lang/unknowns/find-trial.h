/* find-trial.h -- the conditions of `find` at one place u of its unknowns: a run with these values (lang/session/trial.h),
 * the residuals that must vanish as numbers of it, and their slopes by the unknowns.
 *
 * Tests  tests/script/studies/find.sh
 */
#ifndef QDOT_LANG_FIND_TRIAL_H
#define QDOT_LANG_FIND_TRIAL_H

#include "lang/unknowns/find-parts.h"

typedef struct {
    const qdot_find *f;
    size_t m;          /* number of residuals */
    qdot_trial trial;
    qdot_expr from, to; /* time limits of the run */
    double *at;         /* [n] the values u of the unknowns */
    qdot_expr *values;  /* [n] the values of the unknowns as exact numbers */
    qdot_expr *e;       /* [m] the residuals, which must vanish, as expressions */
    double *size;       /* [m] size of the terms whose difference each residual is */
    bool sized;         /* whether `size` is known */
    qdot_slopes slopes; /* derivatives of the run by the unknowns; without a session: not made */
    qdot_find_budget budget;
} qdot_find_trial;

/* Make the run for the unknowns u [n] and its residuals, unless that is done already. Close the trial in any case. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_open(qdot_find_trial *t, const double *u);
void qdot_find_trial_close(qdot_find_trial *t);
/* _limits: find the time limits of the run for the unknowns u; _length: the time between these limits. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_limits(qdot_find_trial *t, const double *u);
QDOT_MUST_CHECK qdot_status qdot_find_trial_length(const qdot_find_trial *t, double *length);
/* Evaluate the residuals [m] of an open trial, with their errors (NaN: unknown). */
QDOT_MUST_CHECK qdot_status qdot_find_trial_numbers(const qdot_find_trial *t, double *value, double *error);
/* Evaluate derivatives [m x n] of the residuals by the unknowns, with errors. Results of other runs are constants. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_slopes(qdot_find_trial *t, double *slope, double *error);

#endif
