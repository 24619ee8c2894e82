/* continuation.h -- all curves of equilibria over one parameter that are found from places at some of its
 * values, and the bifurcations on them.
 *
 * From each equilibrium at a few values of p a curve is followed both ways by pseudo-arclength
 * (rest-path.h), until p leaves its range, a coordinate its domain, the curve closes, or nothing is
 * found further on. Between two points a sign change of dp/ds, of the determinant, or a change of the
 * number of growing roots by two says that there is a fold, a crossing, a Hopf point, which is then
 * located (bifurcation.h). At a crossing the other curve is followed, too. A curve that is known
 * already is not followed again. A closed curve that is met at none of these values, and is not
 * connected with one that is, is not found.
 *
 * Tests  tests/sim/test_continuation.c, tests/script/continue.lag
 */
#ifndef QDOT_SIM_CONTINUATION_H
#define QDOT_SIM_CONTINUATION_H

#include "sim/study/branch.h"

/* Follow all, p from `least` to `most`. From {0}; cleared in any case. Where it is interrupted, what is
 * known stays, and the status is QDOT_OK. QDOT_EFAILED if there is nothing to begin with. */
QDOT_MUST_CHECK qdot_status qdot_continuation_find(qdot_equilibrium_curve *c, double least,
                                                   double most, qdot_continuation *out);
void qdot_continuation_clear(qdot_continuation *x);

#endif
