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
    size_t m;          /* residuals */
    qdot_trial trial;
    qdot_expr from, to; /* of its run */
    double *at;         /* [n] the place u */
    qdot_expr *values;  /* [n] the same, exact */
    qdot_expr *e;       /* [m] what must vanish */
    double *size;       /* [m] of what is subtracted in e */
    bool sized;         /* the latter are known */
    qdot_slopes slopes; /* by the unknowns; without a session: not made */
    qdot_find_budget budget;
} qdot_find_trial;

/* Make the run for the unknowns u [n], and the residuals; nothing to do if it is made. Close the trial in any case. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_open(qdot_find_trial *t, const double *u);
void qdot_find_trial_close(qdot_find_trial *t);
/* Find the limits of the run for the unknowns u; the length of the run between the limits. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_limits(qdot_find_trial *t, const double *u);
QDOT_MUST_CHECK qdot_status qdot_find_trial_length(const qdot_find_trial *t, double *length);
/* The residuals [m] of an open trial, with their errors (NaN: unknown). */
QDOT_MUST_CHECK qdot_status qdot_find_trial_numbers(const qdot_find_trial *t, double *value, double *error);
/* Their slopes [m x n] by the unknowns, with their errors. Numbers of other runs are constants. */
QDOT_MUST_CHECK qdot_status qdot_find_trial_slopes(qdot_find_trial *t, double *slope, double *error);

#endif
