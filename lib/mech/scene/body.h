/* body.h -- angular velocity and velocities of points of rigid bodies, linear in q'. Internal to mech/. */
#ifndef QDOT_MECH_BODY_H
#define QDOT_MECH_BODY_H

#include "mech/scene/scene.h"

/* The angular velocity, from the rotation matrix or the angle; the other: its coefficient of q_i'. */
qdot_expr qdot_body_spin(qdot_scene *s, const qdot_body *body);
qdot_expr qdot_body_partial_spin(qdot_scene *s, const qdot_body *body, qdot_expr q);
/* The rotation of the plane by an angle, a 2x2 MAT. */
qdot_expr qdot_body_rotation_in_plane(qdot_pool *pool, qdot_expr angle);
/* Steiner's theorem: what a mass at d, in 2 or 3 dimensions, has more of inertia than about its centre, m (|d|^2 1 - d d^T)
 * as a MAT; in the plane m |d|^2. */
qdot_expr qdot_body_steiner(qdot_pool *pool, qdot_expr mass, qdot_expr d);
/* The derivative d velocity(body, place)/dq_i' of the velocity of a body's point by a generalized velocity. */
qdot_expr qdot_body_partial_velocity(qdot_scene *s, const qdot_body *body, qdot_expr place,
                                     qdot_expr q);

#endif
