/* declared.h -- prints a declared name as the statement that declares it. */
#ifndef QDOT_LANG_DECLARED_H
#define QDOT_LANG_DECLARED_H

#include "base/text.h"
#include "lang/session/names.h"
#include "lang/session/parts.h"

/* Append the statement that declares a name; of a long value only its size. */
QDOT_MUST_CHECK qdot_status qdot_declared_print(qdot_session *session, const qdot_name *name,
                                                qdot_text *out);

#endif
