/* objects.h -- reads operands that several statements share, about particles, bodies, springs ... */
#ifndef QDOT_LANG_OBJECTS_H
#define QDOT_LANG_OBJECTS_H

#include "lang/syntax/record.h"
#include "mech/scene/things.h"

/* Read the label at the beginning of a declaration, `[NAME:]`; NULL if there is none. */
QDOT_MUST_CHECK qdot_status qdot_object_label(qdot_record *r, const char **label);
/* Add a potential or dissipation whose expression is the operand `term`. */
QDOT_MUST_CHECK qdot_status qdot_object_term(qdot_record *r, const qdot_filled *term,
                                             qdot_scene_kind kind);
/* If expression k of the operand is just the name of a particle or body, find this label; else NULL. */
QDOT_MUST_CHECK qdot_status qdot_object_particle_or_body(qdot_record *r, const qdot_filled *place,
                                                         size_t k, char **label);
/* Read `[NAME] between A, B` as the ends of a spring, damper or rod. */
QDOT_MUST_CHECK qdot_status qdot_object_ends(qdot_record *r, qdot_link *link);
/* Find what a force acts `on`: a coordinate, or *label of a particle or body (tried first if label_first). */
QDOT_MUST_CHECK qdot_status qdot_object_target(qdot_record *r, const qdot_filled *on, bool label_first,
                                               qdot_expr *coordinate, const char **label);

#endif
