/* lagrange.h -- the terms of Lagrange's equations that do not contain accelerations. Internal to mech/. */
#ifndef QDOT_MECH_LAGRANGE_H
#define QDOT_MECH_LAGRANGE_H

#include "mech/scene/scene.h"

/* The expression -(d/dt dF/dq_i' - dF/dq_i) at q'' = 0, for any F(q, q', t). */
qdot_expr qdot_lagrange_forcing(qdot_scene *s, qdot_expr F, size_t i);
/* The expression d/dt dT/dq_i' - dT/dq_i at q'' = 0, simplified. */
qdot_expr qdot_lagrange_rest(qdot_scene *s, size_t i);

/* The component f_i of the right-hand side of M q'' = f, simplified for printing. */
qdot_expr qdot_lagrange_people_forcing(qdot_scene *s, size_t i);

#endif
