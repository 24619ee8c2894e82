/* fold-guess.h -- where a curve turns beside a crossing.
 *
 * Near a crossing no step finds its curve reliably, and the equations of a fold are nearly singular. On either side of
 * it, at s = c - 3 h, c - h, c + h, c + 3 h along the curve, the tangent's part along p and the places are known; the
 * cubic through them passes the crossing.
 *
 * Tests  tests/script/continue/continue-near.lag
 */
#ifndef QDOT_SIM_FOLD_GUESS_H
#define QDOT_SIM_FOLD_GUESS_H

#include "sim/branches/path.h"

/* The place y [n + 1] at which the curve through a has no part along p, by points at h and 3 h from the crossing;
 * *found: false where they are no points of one curve or it does not turn among them. */
QDOT_MUST_CHECK qdot_status qdot_fold_guess(qdot_path *x, const qdot_path_point *a, const double *crossing, double h,
                                            double *y, bool *found);

#endif
