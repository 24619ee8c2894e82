/* ask.h -- what statements ask of values. */
#ifndef QDOT_LANG_ASK_H
#define QDOT_LANG_ASK_H

#include "lang/session/session.h"

/* Whether a number that a run gave stands in e. */
bool qdot_ask_is_measured(qdot_session *session, qdot_expr e);

#endif
