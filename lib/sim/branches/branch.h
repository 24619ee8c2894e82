/* branch.h -- one way along a curve: its points, and the bifurcations between them.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_BRANCH_H
#define QDOT_SIM_BRANCH_H

#include "sim/branches/branch-parts.h"

/* Follow the curve from a, which is judged, along a->t; points behind a are added to `branch`, the
 * bifurcations that are met to s->all, crossings to s->crossings. branch->end[1]. */
QDOT_MUST_CHECK qdot_status qdot_branch_follow(qdot_branch_search *s, const qdot_path_point *a,
                                               qdot_branch *branch);

#endif
