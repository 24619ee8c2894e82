/* phase-symbols.h -- p[q] as a momentum, and as a coordinate of phase space (phase-space.h).
 *
 * Tests   tests/mech/hamilton/test_phase_space.c
 */
#ifndef QDOT_MECH_PHASE_SYMBOLS_H
#define QDOT_MECH_PHASE_SYMBOLS_H

#include "mech/scene/things.h"

/* Whether the scene states an H, and no Lagrangian was found. */
bool qdot_phase_space_needed(const qdot_scene *s);

/* The coordinate of the phase space that is the momentum of q; and the symbol p[q] for such a coordinate, nil for another one. */
qdot_expr qdot_phase_space_coordinate(const qdot_scene *s, qdot_expr q);
qdot_expr qdot_phase_space_momentum(const qdot_scene *s, qdot_expr coordinate);
/* The expression e with the coordinates p[q] and their rates in place of the momenta; and the other way. */
qdot_expr qdot_phase_space_inward(const qdot_scene *s, qdot_expr e);
qdot_expr qdot_phase_space_outward(const qdot_scene *s, qdot_expr e);

#endif
