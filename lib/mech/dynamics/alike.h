/* alike.h -- expressions that differ only in their symbols are simplified once. Internal to
 * mech/. */
#ifndef QDOT_MECH_ALIKE_H
#define QDOT_MECH_ALIKE_H

#include "mech/scene/scene.h"

/* e simplified; by substitution if the same form with other symbols was simplified before: of the
 * N^2 entries of a chain's M one is enough. */
qdot_expr qdot_mech_alike(qdot_scene *s, qdot_expr e);

#endif
