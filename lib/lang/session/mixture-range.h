/* mixture-range.h -- the extrema, the mean, the drift of an expression along several runs.
 *
 * As sim/read/range.c does for one run: between the steps of all runs the expression becomes
 * Chebyshev polynomials on parts that are halved until these represent it. The extrema of the
 * polynomials are evaluated. The error is that of the values: the largest value lies between the
 * largest of x - error and the largest of x + error.
 *
 * Tests  tests/script/several-ranges.lag
 */
#ifndef QDOT_LANG_MIXTURE_RANGE_H
#define QDOT_LANG_MIXTURE_RANGE_H

#include "lang/session/mixture.h"

/* Between range [2] (NULL: the times that all runs cover). Errors: QDOT_EDOMAIN outside a run,
 * where the expression has no value, or where it grows beyond all bounds. */
QDOT_MUST_CHECK qdot_status qdot_mixture_range(qdot_mixture *x, qdot_range_kind kind,
                                               const double *range, double *value,
                                               double *error);

#endif
