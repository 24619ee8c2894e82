/* alike.h -- what is alike but for its symbols is simplified once. Internal to mech/. */
#ifndef QDOT_MECH_ALIKE_H
#define QDOT_MECH_ALIKE_H

#include "mech/scene/scene.h"

/* Simplified, by substitution where the same form with other symbols was simplified before: of
 * the N^2 entries of a chain's M one is enough. */
qdot_expr qdot_mech_alike(qdot_scene *s, qdot_expr e);

#endif
