/* rest-continuation.h -- all curves of equilibria over one parameter that are found from places at some of its
 * values, and the bifurcations on them (continuation.h).
 *
 * Where the equilibria are known exactly (mech/study/equilibrium-set.h), from each member in each cell; members that no
 * steps can follow, at corners and at degenerate places, are drawn. Else between folds that exclusion finds: a closed curve
 * that is met at none of these values, and is not connected with one that is, is not found.
 * out->complete tells the two apart.
 *
 * Tests  tests/sim/branches/test_continuation.c, tests/script/continue/continue.lag
 */
#ifndef QDOT_SIM_REST_CONTINUATION_H
#define QDOT_SIM_REST_CONTINUATION_H

#include "mech/study/equilibrium-curve.h"
#include "sim/branches/continuation.h"

/* Follow all, p from `least` to `most`. From {0}; cleared in any case. Where it is interrupted, what is
 * known stays, and the status is QDOT_OK. QDOT_EFAILED if there is nothing to begin
 * with, or proved to be none. */
QDOT_MUST_CHECK qdot_status qdot_rest_continuation_find(qdot_equilibrium_curve *c, double least,
                                                        double most, qdot_continuation *out);

#endif
