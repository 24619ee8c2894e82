/* form.h -- what a statement is, by its first tokens.
 *
 *   theta = ..., f(u) = ..., r[k] = ...    a definition
 *   potential k*x^2/2, run 0..5            the statement of a word
 *   T == m*x'^2/2                          a comparison, which is `check`
 *   T, sin(theta) = 0, theta' = 2          a value; an equation is one
 *   partcle bob mass m                     unknown: a name without a meaning, and another one
 *
 * Tests  tests/script/derive/equations.lag, tests/lang/hints.def
 */
#ifndef QDOT_LANG_FORM_H
#define QDOT_LANG_FORM_H

#include "lang/source/token.h"
#include "lang/syntax/statement.h"

typedef enum {
    QDOT_FORM_DEFINITION,
    QDOT_FORM_WORD,
    QDOT_FORM_COMPARISON,
    QDOT_FORM_VALUE,
    QDOT_FORM_UNKNOWN
} qdot_form;

/* The form of the statement that begins at `first`. NAME(args) = EXPR is a definition unless NAME is
 * a function of the language, an argument is no name that can be taken, or it is a function of the
 * user's that is applied: a declared name stands in place of its argument (f(u) = u^2, then f(x) = x), or all its
 * arguments are declared and the right side holds none of them (f(x) = x^2, then f(x) = 0). */
qdot_form qdot_statement_form(const qdot_session *session, const qdot_token *first);

/* The table row of the statement whose word the token is; NULL: the token is no such word. */
const qdot_statement *qdot_statement_row(const qdot_token *word);

/* Whether the word of a statement at `name` is used as a name here: `run*2`, a user's own `scene`. */
bool qdot_statement_is_name(const qdot_session *session, const qdot_token *name,
                            const qdot_statement *row);

/* Whether a name may be an argument in a function definition; pi, sin and dtheta may not. */
bool qdot_statement_is_free_argument(const qdot_session *session, const char *name);

#endif
