/* function.h -- functions defined by the user: NAME(u, v) = EXPR.
 *
 * A function is the text of its body. A call reads that text with the arguments in place of the
 * formal names, so `f(u, x) = diff(u, x) + 1` differentiates what it is given. Inside a body a name
 * means, in order: a formal argument; an index of a `for` that ran when the function was defined, with
 * its value at that time; what is declared at the time of the call. Names bound by a loop, a sum
 * or another function around the call are hidden.
 *
 * Tests: tests/script/definitions/functions.lag, tests/bad/definitions/function-*.lag, tests/lang/language/test_evaluate.c.
 */
#ifndef QDOT_LANG_FUNCTION_H
#define QDOT_LANG_FUNCTION_H

#include "base/text.h"
#include "lang/language/cursor.h"
#include "lang/session/names.h"

/* The largest depth of nested function calls, counted over all functions. */
enum { QDOT_FUNCTION_DEPTH = 500 };

/* `NAME(names) = EXPR` at the cursor: a definition, not declared yet. The body is parsed for its
 * syntax alone. entry->body, the caller's to release in any case, may be NULL. */
QDOT_MUST_CHECK qdot_status qdot_function_read(qdot_cursor *c, qdot_name *entry);

/* An argument of a function call. */
typedef struct {
    qdot_expr value;
    const char *label; /* label of the particle or body whose position the argument is; NULL: none */
} qdot_argument;

/* The function `entry` with `primes` of n arguments. One argument for which the body has no
 * meaning - a list, a vector, a matrix, an equation where it takes numbers - is taken member by
 * member. *over: the coordinates that the value's entries go by, or nil. An error names the
 * place in the body. QDOT_ELIMIT: a recursion deeper than QDOT_FUNCTION_DEPTH. */
QDOT_MUST_CHECK qdot_status qdot_function_call(qdot_session *session, const qdot_name *entry,
                                               unsigned primes, uint32_t n,
                                               const qdot_argument *args, qdot_expr *value,
                                               qdot_expr *over);

/* Append the definition of a function as text: "f(u, x) = diff(u, x) + 1". */
QDOT_MUST_CHECK qdot_status qdot_function_print(qdot_session *session, const qdot_name *entry,
                                                qdot_text *out);

/* Whether the function's body contains `name` (or the family it is a member of), other than as an argument. */
bool qdot_function_mentions(const qdot_pool *pool, const qdot_name *entry, const char *name);

#endif
