/* distance-ends.h -- between which points of bodies a constraint keeps the distance.
 *
 * The constraint says u.u = L^2 or sqrt(u.u) = L, u = P - Q, and shows the squares of u's components
 * only, in any order. P is sought in each body, r + R rho with rho constant, Q in another body, at
 * a particle or fixed in space. With S the coordinates that r and R hold and Q does not,
 *
 *     P = (r without its terms that hold S) + (the terms of u that hold S),   Q = P - u,
 *
 * for each order and sign of the components; of these the first is taken for which
 * R^T (P - r) has no coordinate and Q is where it is sought.
 *
 * Tests  tests/mech/study/test_rods.c
 */
#ifndef QDOT_MECH_DISTANCE_ENDS_H
#define QDOT_MECH_DISTANCE_ENDS_H

#include "mech/scene/things.h"

/* The ends, expanded; the second is the one that is fixed in space, if one is. Both are nil if the
 * constraint keeps no such distance, or it is not found. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_mech_distance_ends(qdot_scene *s,
                                                    const qdot_constraint *constraint,
                                                    qdot_expr ends[2]);

#endif
