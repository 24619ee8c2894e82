/* start-speeds.h -- the velocities that a start by speeds gives. */
#ifndef QDOT_LANG_START_SPEEDS_H
#define QDOT_LANG_START_SPEEDS_H

#include "lang/session/parts.h"

/* Solve A q' = b, the equations of the speeds and constraints at q0 [coordinates], NULL: those of the start, and t0, for the
 * velocities v0. A speed of `unknowns` [n] keeps its symbol; of the others the start gives the value, 0 if it names none.
 * QDOT_EINVAL: the velocities are not determined. */
QDOT_MUST_CHECK qdot_status qdot_session_start_velocities(qdot_session *session, size_t n, const qdot_expr *unknowns,
                                                          const qdot_expr *q0, qdot_expr t0, qdot_expr *v0);

#endif
