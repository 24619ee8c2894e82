/* declared.h -- declared names as the statements that declare them. */
#ifndef QDOT_LANG_DECLARED_H
#define QDOT_LANG_DECLARED_H

#include "lang/session/session.h"

/* Append the statement; a long value by its size. */
QDOT_MUST_CHECK qdot_status qdot_declared_print(qdot_session *session, const qdot_name *name,
                                                qdot_text *out);

#endif
