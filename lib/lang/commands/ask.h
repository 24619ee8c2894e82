/* ask.h -- the answer of a value, for statements that ask for one among others. */
#ifndef QDOT_LANG_ASK_H
#define QDOT_LANG_ASK_H

#include "lang/session/session.h"

/* As the statement `name` alone is answered: lists member by member, numbers of runs with their
 * errors. It is not remembered as `%`. */
QDOT_MUST_CHECK qdot_status qdot_ask_answer(qdot_session *session, const char *name,
                                            qdot_expr value);

#endif
