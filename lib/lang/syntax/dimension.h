/* dimension.h -- the dimension that belongs into a hole of a statement, such as a mass behind `mass`.
 *
 * The rows are in dimension.def. Nothing is done in a session without units.
 */
#ifndef QDOT_LANG_SYNTAX_DIMENSION_H
#define QDOT_LANG_SYNTAX_DIMENSION_H

#include "lang/session/parts.h"
#include "lang/syntax/usage.h"

/* The value of the hole `node` of a statement; on: the coordinate on which a force or torque acts, or nil. QDOT_ETYPE: another
 * dimension belongs there. */
QDOT_MUST_CHECK qdot_status qdot_hole_dimension(qdot_session *session, const char *statement, const qdot_usage_node *node,
                                                qdot_expr on, qdot_expr value);

#endif
