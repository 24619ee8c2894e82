/* mass-matrix.h -- the mass matrix M, and b and c, of T = 1/2 q'Mq' + b q' + c. Internal to mech/. */
#ifndef QDOT_MECH_MASS_MATRIX_H
#define QDOT_MECH_MASS_MATRIX_H

#include "mech/scene/scene.h"

/* Compute M, b, c of T = 1/2 q'Mq' + b q' + c, unless they are stored; false on failure. */
bool qdot_mass_get(qdot_scene *s);
qdot_expr qdot_mass_entry(qdot_scene *s, size_t i, size_t j); /* M_ij of the mass matrix; call qdot_mass_get first */
bool qdot_mass_slopes(qdot_scene *s);
/* Entry i, j of the mass matrix d2L/dq'dq', simplified, of L = T - V (V may contain velocities) or of the stated L. */
qdot_expr qdot_mass_of_lagrangian(qdot_scene *s, size_t i, size_t j);

#endif
