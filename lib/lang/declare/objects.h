/* objects.h -- operands that statements of things in a scene share. */
#ifndef QDOT_LANG_OBJECTS_H
#define QDOT_LANG_OBJECTS_H

#include "lang/syntax/record.h"

/* The label of `[NAME:]`; NULL: none. */
QDOT_MUST_CHECK qdot_status qdot_object_label(qdot_record *r, const char **label);
/* Add a potential or dissipation, whose value is the hole `term`. */
QDOT_MUST_CHECK qdot_status qdot_object_term(qdot_record *r, const qdot_filled *term,
                                             qdot_scene_kind kind);
/* The label of a particle or body where expression k of the hole is that name alone; NULL where it is anything else. */
QDOT_MUST_CHECK qdot_status qdot_object_particle_or_body(qdot_record *r, const qdot_filled *place,
                                                         size_t k, char **label);
/* `[NAME] between A, B` into name, at and end of the link. */
QDOT_MUST_CHECK qdot_status qdot_object_ends(qdot_record *r, qdot_link *link);
/* What acts `on` the hole: a coordinate, or (label_first, or else) *label, a particle or body. */
QDOT_MUST_CHECK qdot_status qdot_object_target(qdot_record *r, const qdot_filled *on, bool label_first,
                                               qdot_expr *coordinate, const char **label);

#endif
