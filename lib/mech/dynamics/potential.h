/* potential.h -- the potential energy V and its parts. Internal to mech/. */
#ifndef QDOT_MECH_POTENTIAL_H
#define QDOT_MECH_POTENTIAL_H

#include "mech/scene/scene.h"

/* The squared distance u.u, simplified, for the vector u between the ends of spring or damper k. */
qdot_expr qdot_link_square(qdot_scene *s, bool damper, size_t k);
qdot_expr qdot_spring_potential(qdot_scene *s, size_t k);
/* The potential energy without that of gravity; nil on failure. */
qdot_expr qdot_potential_but_gravity(qdot_scene *s);
/* The sum of those terms of V that depend on velocities, which declared potentials may contain. */
qdot_expr qdot_potential_with_velocities(qdot_scene *s);
/* The potential energy before it is simplified; nil on failure. */
qdot_expr qdot_potential_raw(qdot_scene *s);

#endif
