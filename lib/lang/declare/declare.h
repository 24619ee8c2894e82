/* declare.h -- helper functions for statements that declare names and give them values. */
#ifndef QDOT_LANG_DECLARE_H
#define QDOT_LANG_DECLARE_H

#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/syntax/definition.h"

/* Declare an entry whose name stands at `start`; file and line are filled in. A notice is given where it hides a value of the
 * language. definition: the statement, if it is NAME = EXPR; else NULL. */
QDOT_MUST_CHECK qdot_status qdot_declare_name(qdot_cursor *c, const qdot_token *start, const qdot_definition *definition,
                                              qdot_name *entry);
/* Carry out the definition at the cursor: NAME = EXPR, NAME[K] = EXPR, NAME(X) = EXPR. */
QDOT_MUST_CHECK qdot_status qdot_declare_definition(qdot_cursor *c);

/* Declare an undefined function of n arguments by their names. data: the text of the statement that gives its values by a
 * table, from its name on; NULL: there is none. */
QDOT_MUST_CHECK qdot_status qdot_declare_undefined(qdot_cursor *c, const qdot_token *start, const char *name, size_t n,
                                                   const char *const *arguments, struct qdot_function_body *data);

/* After a symbol NAME is declared: let an earlier `function x(NAME)` become a function of that symbol. */
QDOT_MUST_CHECK qdot_status qdot_declare_meet_functions(qdot_session *session,
                                                        const char *name,
                                                        qdot_expr symbol);

#endif
