/* branch-marks.h -- bifurcations that are kept, each once; pairs of them between two points of a curve.
 *
 * Where the determinant dips to rounding without a change of its sign (dips.h), two crossings lie closer together than
 * the steps can be short. Newton's method on the larger system (rest-bifurcation.h) leads from either side of the dip
 * to one of them each, however near they are; where it does not, several curves meet at one place.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_BRANCH_MARKS_H
#define QDOT_SIM_BRANCH_MARKS_H

#include "sim/branches/branch-parts.h"
#include "sim/branches/dips.h"

/* Reduce angles to -pi < q <= pi if the equations are known to have the period 2 pi in them. */
void qdot_branch_turn_back(const qdot_path *x, double *y);

/* The longest step from y along its curve that does not leap to another curve near two close crossings. */
double qdot_branch_longest_near(const qdot_branch_search *s, const double *y);

/* Keep the bifurcation b, if it is new, with the direction of the other curve; *mark is 1 + its index. Owns both
 * from then on. */
QDOT_MUST_CHECK qdot_status qdot_branch_mark(qdot_branch_search *s, qdot_bifurcation *b,
                                             double *other, size_t *mark);

/* A fold that lies within `in` but is not located may be a crossing, at which the curve that has no part along p turns
 * its tangent, too: where one is proved within the errors of *fold, that becomes it, with `other` the direction of the
 * other curve, and *answer is QDOT_BIFURCATION_FOUND. *outside becomes true where it lies on the end of a domain. */
QDOT_MUST_CHECK qdot_status qdot_branch_fold_is_crossing(qdot_branch_search *s,
                                                         const qdot_bifurcation_bracket *in,
                                                         qdot_bifurcation *fold, double *other,
                                                         qdot_bifurcation_answer *answer,
                                                         bool *outside);
/* A fold on the curve from in->a, which leads to the crossing b, near that on either side: b becomes it, if one is
 * proved. */
QDOT_MUST_CHECK qdot_status qdot_branch_fold_beside(qdot_branch_search *s, const qdot_bifurcation_bracket *in,
                                                    qdot_bifurcation *b);

/* Two crossings beside the kept point `place`, `way` along the curve or nearer; *both is false where they are not
 * told apart: then nothing is kept. They and a point between them become points of the branch. */
QDOT_MUST_CHECK qdot_status qdot_branch_mark_pair(qdot_branch_search *s, qdot_dips *d,
                                                  size_t place, double way, qdot_branch *branch,
                                                  bool *both);
/* Record a point at which several curves meet; its position is known with the error `apart`. */
QDOT_MUST_CHECK qdot_status qdot_branch_mark_zero(qdot_branch_search *s, const qdot_dips *d,
                                                  size_t place, double apart, qdot_branch *branch);

#endif
