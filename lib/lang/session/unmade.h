/* unmade.h -- what is not made for Lagrangians with q'' (qdot_higher of mech/scene/things.h), or for delays (expr/symbol.h).
 *
 * Tests  tests/bad/derive/higher-*.lag, tests/bad/data/delay.out
 */
#ifndef QDOT_LANG_UNMADE_H
#define QDOT_LANG_UNMADE_H

#include "lang/session/parts.h"

/* QDOT_ENOTBUILT if the scene's Lagrangian holds second derivatives, or the scene coordinates at an earlier time, and the statement,
 * value or function `word` of the language, or `start RUN`, is not made for them. */
QDOT_MUST_CHECK qdot_status qdot_session_refuse_unmade(const qdot_session *session, const char *word);

#endif
