/* declared.h -- prints a declared name as the statement that declares it. */
#ifndef QDOT_LANG_DECLARED_H
#define QDOT_LANG_DECLARED_H

#include "base/text.h"
#include "lang/session/names.h"
#include "lang/session/parts.h"

/* Append the statement that declares a name; of a long value only its size. */
QDOT_MUST_CHECK qdot_status qdot_declared_print(qdot_session *session, const qdot_name *name,
                                                qdot_text *out);
/* Append the line of the scene that declares a label, as that of a particle; nothing where there is none. */
QDOT_MUST_CHECK qdot_status qdot_declared_label(qdot_session *session, const char *label, qdot_text *out);

/* Append the statement `run` by which the run of this name was made; false if there is no such run. */
bool qdot_declared_run(const qdot_session *session, const char *name, qdot_text *out);

#endif
