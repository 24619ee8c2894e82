/* declare.h -- helpers of the statements that declare names and give them values. */
#ifndef QDOT_LANG_DECLARE_H
#define QDOT_LANG_DECLARE_H

#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/source/token.h"

/* Declare an entry whose name stands at `start`; file and line are filled in. A notice
 * is given where it hides a value of the language. */
QDOT_MUST_CHECK qdot_status qdot_declare_name(qdot_cursor *c, const qdot_token *start,
                                              qdot_name *entry);

/* After NAME is declared, an earlier `function x(NAME)` becomes a function of that symbol. */
QDOT_MUST_CHECK qdot_status qdot_declare_meet_functions(qdot_session *session,
                                                        const char *name,
                                                        qdot_expr symbol);

#endif
