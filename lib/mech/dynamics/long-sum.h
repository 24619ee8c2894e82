/* long-sum.h -- a long sum by the coordinates that its terms hold: V of N bodies has N^2 terms, of which a coordinate
 * is in N, so that all derivatives of V take N^2 terms to be looked at, not N^3.
 *
 * Tests  tests/mech/dynamics/test_long-sum.c
 */
#ifndef QDOT_MECH_LONG_SUM_H
#define QDOT_MECH_LONG_SUM_H

#include "mech/scene/scene.h"

/* The sum of those terms of V that hold coordinate i: its derivative by q_i is that of V. V itself if it is no sum of
 * more than 32 terms. The terms are looked at once for all coordinates, until the scene changes. Nil: the pool has
 * failed. */
qdot_expr qdot_long_sum_with(qdot_scene *scene, qdot_expr V, size_t i);

#endif
