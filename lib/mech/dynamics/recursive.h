/* recursive.h -- M and f of the equations M q'' = f, by nested sums over inertial terms. Internal to mech/. */
#ifndef QDOT_MECH_RECURSIVE_H
#define QDOT_MECH_RECURSIVE_H

#include "mech/scene/cache.h"

/* Whether no mass varies with position, time or velocity, as qdot_recursive_forcing needs. */
bool qdot_recursive_applies(const qdot_scene *s, const qdot_kinematics *k);
/* Find f [n], the right-hand side of M q'' = f, by nested sums; false on failure. */
bool qdot_recursive_forcing(qdot_scene *s, qdot_kinematics *k, qdot_expr *f);
/* Entry M_ij of the mass matrix, with products shared by the entries of a row or column. Nil on failure. */
qdot_expr qdot_recursive_mass(qdot_scene *s, qdot_kinematics *k, size_t i, size_t j);

#endif
