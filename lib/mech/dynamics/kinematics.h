/* kinematics.h -- the inertial terms w x' y' of T, grouped by their Jacobians (scene/cache.h). Internal to mech/. */
#ifndef QDOT_MECH_KINEMATICS_H
#define QDOT_MECH_KINEMATICS_H

#include "mech/scene/cache.h"

/* The inertial terms w x' y' of T, their sets and the groups of their derivatives; NULL on failure. */
qdot_kinematics *qdot_kinematics_get(qdot_scene *s);
/* The inertial terms alone, added to k->terms. */
QDOT_MUST_CHECK qdot_status qdot_kinematics_terms(qdot_scene *s, qdot_kinematics *k);
/* _rest, _place: the groups of x'' and of x in k, computed when first needed; that adds sets to k. NULL on failure. */
const qdot_groups *qdot_kinematics_rest(qdot_scene *s, qdot_kinematics *k);
const qdot_groups *qdot_kinematics_place(qdot_scene *s, qdot_kinematics *k);
uint32_t qdot_kinematics_and(qdot_scene *s, qdot_kinematics *k, uint32_t a, uint32_t b);
qdot_expr qdot_kinematics_weight(qdot_scene *s, qdot_kinematics *k, uint32_t set);
/* The sum of w_p a_p b_p over the inertial terms p, for functions a, b given in groups; people: simplified. */
qdot_expr qdot_kinematics_pair(qdot_scene *s, qdot_kinematics *k, const qdot_groups *a,
                               const qdot_groups *b, bool people);
/* The sum of w_p g_axis(p) a_p over the inertial terms p, with g gravity, for a function a given in groups. */
qdot_expr qdot_kinematics_gravity(qdot_scene *s, qdot_kinematics *k,
                                  const qdot_groups *a);

#endif
