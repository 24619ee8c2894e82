/* mixture.h -- an expression along several runs at once, evaluated at times.
 *
 * Every symbol of the expression is read along its own run; what names none is read along one run
 * that the caller names. The error of a value is the sum of the changes that the error of each
 * symbol makes.
 *
 * Tests  tests/script/studies/ranges.lag, tests/script/sweeps/several-ranges.lag
 */
#ifndef QDOT_LANG_MIXTURE_H
#define QDOT_LANG_MIXTURE_H

#include "lang/session/member.h"
#include "sim/run/run.h"

typedef struct qdot_mixture qdot_mixture;

/* Of e, with the values of `set`; `run`: of what names no run, NULL: the latest. On QDOT_OK the
 * caller frees it. The session and its runs must outlive it. */
QDOT_MUST_CHECK qdot_status qdot_mixture_new(qdot_session *session, const char *run,
                                             qdot_expr e, qdot_mixture **out);
void qdot_mixture_free(qdot_mixture *x);

/* Evaluate an expression of several runs at these times. QDOT_EDOMAIN: a time lies outside one of the runs. */
QDOT_MUST_CHECK qdot_status qdot_mixture_values(qdot_mixture *x, const qdot_samples *at);

/* Its extremum, mean or drift over range [2] (NULL: all times that its runs have in common), and
 * the error. QDOT_EDOMAIN: outside a run, or undefined in it. */
QDOT_MUST_CHECK qdot_status qdot_mixture_range(const qdot_mixture *x, qdot_range_kind kind,
                                               const double *range, double *value,
                                               double *error);

#endif
