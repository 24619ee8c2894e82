/* outdated.h -- quantities of the scene, such as energy, along a run that was made before the scene changed.
 *
 * Coordinates and velocities along such a run are its own; a quantity is an expression of the scene as it is now. A definition
 * keeps the expression that it had when it was made, so it is passed over.
 *
 * Tests  tests/script/runs/outdated.lag, tests/api/test_api.c
 */
#ifndef QDOT_LANG_OUTDATED_H
#define QDOT_LANG_OUTDATED_H

#include "lang/session/parts.h"
#include "lang/source/token.h"

/* Give a notice for each quantity of the scene that the tokens from .. to - 1, or the functions called in them, read along the run
 * (NULL: the latest), if the scene has changed since that was made. A name behind a point, as in a.energy, belongs to another run
 * and is passed over. */
QDOT_MUST_CHECK qdot_status qdot_outdated_notice(qdot_session *session, const char *run, const qdot_token *from,
                                                 const qdot_token *to);
/* The same for the arguments of a call, whose name is `call`. */
QDOT_MUST_CHECK qdot_status qdot_outdated_notice_call(qdot_session *session, const char *run, const qdot_token *call);
/* The same for what stands behind the run's name and a point: a name, or an expression in brackets. */
QDOT_MUST_CHECK qdot_status qdot_outdated_notice_member(qdot_session *session, const qdot_token *run);

#endif
