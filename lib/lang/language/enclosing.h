/* enclosing.h -- where a token stands: in which statement, in the brackets of which calls. */
#ifndef QDOT_LANG_ENCLOSING_H
#define QDOT_LANG_ENCLOSING_H

#include "lang/functions/builtin.h"
#include "lang/language/cursor.h"

/* The first token of the statement of `token`. */
const qdot_token *qdot_enclosing_statement(const qdot_cursor *c, const qdot_token *token);
/* The bracket that is open at `token` in the statement that begins at `first`; NULL: none is. */
const qdot_token *qdot_enclosing_bracket(const qdot_token *first, const qdot_token *token);
/* The function of the language whose arguments stand in this bracket (NULL: in none), in that statement; NULL: none. */
const qdot_builtin *qdot_enclosing_call(const qdot_token *first, const qdot_token *open);
/* Whether the token, a name, is the variable of a call, as x in diff(T, x) or subs(T, x = 0). */
bool qdot_enclosing_is_variable(const qdot_token *first, const qdot_token *token);
/* Whether the token is the variable of an integral or a limit, or stands for it in one: x in integral(x^2, x, 0, 1). */
bool qdot_enclosing_binds(const qdot_cursor *c, const qdot_token *token);
/* Whether the multipliers in what is named at `token` are to be replaced by what the equations make of them: in what is
 * asked, as `2*lambda[rod]*L`, and in what calculus is applied to, as diff(lambda[rod], x). They stay symbols in
 * declarations and definitions, beside equations of motion and accelerations, and along runs. */
bool qdot_enclosing_asks_multipliers(const qdot_cursor *c, const qdot_token *token);

#endif
