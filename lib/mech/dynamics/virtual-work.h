/* virtual-work.h -- computes generalized forces. Internal to mech/. */
#ifndef QDOT_MECH_VIRTUAL_WORK_H
#define QDOT_MECH_VIRTUAL_WORK_H

#include "mech/scene/scene.h"

/* The generalized force on coordinate i. people: simplified for printing. applied: without -dV/dq. */
qdot_expr qdot_force_total(qdot_scene *s, size_t i, bool people, bool applied);
/* The force along a state z' = g, g - z': with no mass its equation g - z' = 0 is that of the state. Nil: i is no state. */
qdot_expr qdot_force_of_state(qdot_scene *s, size_t i);
/* The generalized force on coordinate i without that of gravity, not simplified. */
qdot_expr qdot_force_but_gravity(qdot_scene *s, size_t i);
/* The generalized force on coordinate i from the statements `force` and `torque`. */
qdot_expr qdot_force_declared(qdot_scene *s, size_t i);

#endif
