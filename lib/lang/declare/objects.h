/* objects.h -- readers of operands that statements about particles, bodies, springs ... share. */
#ifndef QDOT_LANG_OBJECTS_H
#define QDOT_LANG_OBJECTS_H

#include "lang/syntax/record.h"
#include "mech/scene/things.h"

/* Read the label of `[NAME:]`; NULL if there is none. */
QDOT_MUST_CHECK qdot_status qdot_object_label(qdot_record *r, const char **label);
/* Add a potential or dissipation whose expression is the operand `term`. */
QDOT_MUST_CHECK qdot_status qdot_object_term(qdot_record *r, const qdot_filled *term,
                                             qdot_scene_kind kind);
/* Find the label if expression k of the operand is just the name of a particle or body; NULL otherwise. */
QDOT_MUST_CHECK qdot_status qdot_object_particle_or_body(qdot_record *r, const qdot_filled *place,
                                                         size_t k, char **label);
/* Read `[NAME] between A, B` as the ends of a spring, damper or rod. */
QDOT_MUST_CHECK qdot_status qdot_object_ends(qdot_record *r, qdot_link *link);
/* Find what a force acts `on`: a coordinate, or (first if label_first) *label, a particle or body. */
QDOT_MUST_CHECK qdot_status qdot_object_target(qdot_record *r, const qdot_filled *on, bool label_first,
                                               qdot_expr *coordinate, const char **label);

#endif
