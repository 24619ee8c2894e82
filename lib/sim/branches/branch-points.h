/* branch-points.h -- the points of a branch, in the order of the curve.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_BRANCH_POINTS_H
#define QDOT_SIM_BRANCH_POINTS_H

#include "sim/branches/branch-parts.h"

/* Add y [width] with its stability and mark (1 + the index of a bifurcation; 0: none) behind the others, or before the
 * point `at`. y is copied. */
QDOT_MUST_CHECK qdot_status qdot_branch_add(const qdot_path *x, qdot_branch *branch,
                                            const double *y, qdot_stability stability, size_t mark);
QDOT_MUST_CHECK qdot_status qdot_branch_insert(const qdot_path *x, qdot_branch *branch, size_t at, const double *y,
                                               qdot_stability stability, size_t mark);
void qdot_branch_clear(qdot_branch *branch);

#endif
