/* constraints.h -- notices and checks about constraints.
 *
 * Tests  tests/script/constraints/reactions.lag, tests/script/constraints/integrable.lag
 */
#ifndef QDOT_LANG_CONSTRAINTS_H
#define QDOT_LANG_CONSTRAINTS_H

#include "base/text.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/things.h"

/* Carry out `check [not] integrable LABEL`: a verdict for each component of the constraint. */
QDOT_MUST_CHECK qdot_status qdot_constraints_check_integrable(qdot_record *r, const qdot_filled *name,
                                                              bool not);

/* Append a line that names the redundant constraints, and one if the system cannot move at all. */
void qdot_constraints_print_redundant(const qdot_scene *scene, const qdot_dof *dof,
                                      qdot_text *out);

/* Give a notice for each velocity constraint from index `before` on that is integrable by itself. */
QDOT_MUST_CHECK qdot_status qdot_constraints_tell_disguise(qdot_session *session,
                                                           size_t before);

#endif
