/* mass-matrix.h -- M, b and c of T. Internal to mech/. */
#ifndef QDOT_MECH_MASS_MATRIX_H
#define QDOT_MECH_MASS_MATRIX_H

#include "mech/scene/scene.h"

/* M, b, c of T = 1/2 M q'q' + b q' + c in the cache; false on failure. */
bool qdot_mass_get(qdot_scene *s);
qdot_expr qdot_mass_entry(qdot_scene *s, size_t i, size_t j); /* M_ij; call qdot_mass_get first */
bool qdot_mass_slopes(qdot_scene *s);
/* M of L = T - V (V may hold velocities) or of the stated L: entry i, j, simplified. */
qdot_expr qdot_mass_of_lagrangian(qdot_scene *s, size_t i, size_t j);

#endif
