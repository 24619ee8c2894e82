/* rods.h -- distances of a scene that never change: rods, and points fixed in bodies.
 *
 * A rod joins two points a, b of which one of these is proved:
 *
 *     |a - b|^2, simplified, holds no coordinate                r(q) keeps the distance
 *     d|a - b|^2 and df are parallel, f = 0 holonomic           a constraint keeps it
 *
 * The other end of a rod of r(q) is sought among the particles and, for each coordinate q, at what
 * remains of the position if the terms that hold q are left out: for
 * r2 = r1 + (L*sin(theta2), -L*cos(theta2)) and theta2 that is r1, a hinge even where nothing is
 * declared to be. Of a constraint on one particle alone that is a circle or sphere the centre is
 * found from its gradient; of one between points of bodies both are found from its squares
 * (distance-ends.h).
 *
 * An arm is a point that is fixed in a body, R^T (P - r) without a coordinate, where something
 * is fastened to the body: a hinge of r(q), an end of a spring, damper or rod, a force, a
 * constraint between points, a particle.
 *
 * What is not proved is left out.
 *
 * Tests  tests/mech/study/test_rods.c
 */
#ifndef QDOT_MECH_RODS_H
#define QDOT_MECH_RODS_H

#include "base/memory.h"
#include "mech/scene/things.h"

typedef struct {
    qdot_expr
        ends[2]; /* positions of the two ends, expanded; the second is nearer to a fixed point */
    const char
        *name; /* label of the constraint that keeps the distance, borrowed; NULL: the positions r(q) do */
} qdot_rod;

typedef qdot_vec(qdot_rod) qdot_rods;
typedef qdot_vec(qdot_expr) qdot_arms;

/* Append the rods between particles, hinges and fixed points; none in one dimension. The array is
 * the caller's. Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_mech_rods(qdot_scene *s, qdot_rods *rods);

/* Append the arms of body i: positions, expanded; rods: those of the scene. The array is the caller's.
 * Errors: the pool's. */
QDOT_MUST_CHECK qdot_status qdot_mech_arms(qdot_scene *s, size_t i, const qdot_rods *rods,
                                           qdot_arms *arms);

#endif
