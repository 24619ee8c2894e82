/* rotation.h -- whether a matrix turns a body: R^T R = 1, det R = 1. Internal to mech/.
 *
 * A product of rotations, or the transpose of one, is a rotation: only the matrices are examined of which R was made
 * (expr/factors), each once, so that a chain of N bodies takes work N.
 */
#ifndef QDOT_MECH_ROTATION_H
#define QDOT_MECH_ROTATION_H

#include "mech/scene/scene.h"

/* Refuse a 3x3 matrix that is not a rotation. What is only undecided passes; constraints declared before (of a
 * quaternion's length, say) are used. Errors: QDOT_EDOMAIN. */
QDOT_MUST_CHECK qdot_status qdot_rotation_check(qdot_scene *s, qdot_expr R);

#endif
