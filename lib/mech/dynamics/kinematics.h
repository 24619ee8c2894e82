/* kinematics.h -- the inertial terms, grouped by their Jacobians (scene/cache.h). Internal to mech/. */
#ifndef QDOT_MECH_KINEMATICS_H
#define QDOT_MECH_KINEMATICS_H

#include "mech/scene/cache.h"

/* Terms, sets and Jacobian groups; NULL on failure. */
qdot_kinematics *qdot_kinematics_get(qdot_scene *s);
/* k->rest, k->place, computed when first needed; that adds sets to k. NULL on failure. */
const qdot_groups *qdot_kinematics_rest(qdot_scene *s, qdot_kinematics *k);
const qdot_groups *qdot_kinematics_place(qdot_scene *s, qdot_kinematics *k);
uint32_t qdot_kinematics_and(qdot_scene *s, qdot_kinematics *k, uint32_t a, uint32_t b);
qdot_expr qdot_kinematics_weight(qdot_scene *s, qdot_kinematics *k, uint32_t set);
/* The sum over inertial terms p of w_p a_p b_p for two grouped functions; people: simplified for printing. */
qdot_expr qdot_kinematics_pair(qdot_scene *s, qdot_kinematics *k, const qdot_groups *a,
                               const qdot_groups *b, bool people);
/* The sum over inertial terms p of w_p g_axis(p) a_p, for one grouped function and the gravity fields. */
qdot_expr qdot_kinematics_gravity(qdot_scene *s, qdot_kinematics *k,
                                  const qdot_groups *a);

#endif
