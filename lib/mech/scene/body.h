/* body.h -- spin and velocities of rigid bodies as linear forms in q'. Internal to mech/. */
#ifndef QDOT_MECH_BODY_H
#define QDOT_MECH_BODY_H

#include "mech/scene/scene.h"

/* The angular velocity from the rotation matrix or the angle; its coefficient of q_i'. */
qdot_expr qdot_body_spin(qdot_scene *s, const qdot_body *body);
qdot_expr qdot_body_partial_spin(qdot_scene *s, const qdot_body *body, qdot_expr q);
/* The derivatives of the velocity of a body's point by q': d velocity(body, place)/dq_i'. */
qdot_expr qdot_body_partial_velocity(qdot_scene *s, const qdot_body *body, qdot_expr place,
                                     qdot_expr q);

#endif
