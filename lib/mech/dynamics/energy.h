/* energy.h -- derivatives of the Lagrangian. Internal to mech/. */
#ifndef QDOT_MECH_ENERGY_H
#define QDOT_MECH_ENERGY_H

#include "mech/scene/scene.h"

/* The partial derivative of L by x, a coordinate, velocity or t, from the parts of L; *has: whether L depends on x. */
qdot_expr qdot_lagrangian_slope(qdot_scene *s, qdot_expr x);
bool qdot_lagrangian_has(qdot_scene *s, qdot_expr x, bool *has);
/* Whether dL/dx is proved zero, x a coordinate or t: entry by entry of M and b if V contains no
 * velocities. */
bool qdot_lagrangian_is_still(qdot_scene *s, qdot_expr x);

#endif
