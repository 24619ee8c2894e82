/* continuation.h -- all curves that are found from given places on them and from crossings, with their bifurcations.
 *
 * From each place a curve is followed both ways by pseudo-arclength (path.h), until p leaves its range, an
 * unknown its domain, the curve closes, or nothing is found further on. Between two points a sign change of
 * dp/ds, of the determinant, of a multiplier + 1, or a change of the number of growing motions says that there
 * is a fold, a crossing, a period doubling, a Hopf point, which is then located (bifurcation.h). At a crossing the
 * other curve is followed, too. A curve that is known already is not followed again.
 *
 * Tests  tests/sim/branches/test_continuation.c, test_orbits.c
 */
#ifndef QDOT_SIM_CONTINUATION_H
#define QDOT_SIM_CONTINUATION_H

#include "sim/branches/branch.h"

void qdot_continuation_clear(qdot_continuation *x);

/* Follow the curves through the points at [count * (n + 1)]; curves in s->all already remain there. */
QDOT_MUST_CHECK qdot_status qdot_continuation_follow(qdot_branch_search *s, const double *at,
                                                     size_t count);
/* Follow one arm of the curve along `other` [n + 1] at bifurcation number `at`; if `crossings`,
 * also the curves that cross it. */
QDOT_MUST_CHECK qdot_status qdot_continuation_arm(qdot_branch_search *s, size_t at, const double *other,
                                                  bool crossings);
/* Whether the point y [n + 1] lies on a curve already found. */
QDOT_MUST_CHECK qdot_status qdot_continuation_knows(qdot_branch_search *s, const double *y, bool *known);
/* In any case behind it: frees what is left of the search. Where it was interrupted, what is known stays, and
 * the status is QDOT_OK. */
QDOT_MUST_CHECK qdot_status qdot_continuation_finish(qdot_branch_search *s, qdot_status status);

#endif
