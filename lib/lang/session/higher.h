/* higher.h -- what is not made for Lagrangians with q'' (qdot_higher of mech/scene/things.h).
 *
 * Tests  tests/bad/derive/higher-*.lag
 */
#ifndef QDOT_LANG_HIGHER_H
#define QDOT_LANG_HIGHER_H

#include "lang/session/parts.h"

/* QDOT_ENOTBUILT if the scene's Lagrangian holds second derivatives and this statement, value or function of the language is not
 * made for them. */
QDOT_MUST_CHECK qdot_status qdot_session_refuse_higher(const qdot_session *session, const char *word);

#endif
