/* read.h -- reads the operands of statements: parsed and evaluated, one function for each kind.
 *
 * A statement is a range of a source's tokens, which it reads through a cursor. An expression is
 * parsed to postfix code by precedence with an explicit stack and evaluated by a loop over that
 * code: no recursion, so no depth of brackets breaks it.
 */
#ifndef QDOT_LANG_READ_H
#define QDOT_LANG_READ_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"

/* A whole expression, equations and logic included; stops before the first token that cannot go on (an
 * option word, `,`, `:`, `..`, a closing bracket, the end). */
QDOT_MUST_CHECK qdot_status qdot_read_value(qdot_cursor *c, qdot_expr *value);
/* The same, to be named: *over: the coordinates its entries go by, `G = metric(R)` and
 * G[r, phi]; nil: by numbers only. */
QDOT_MUST_CHECK qdot_status qdot_read_named(qdot_cursor *c, qdot_expr *value,
                                            qdot_expr *over);
/* Read one side of `==`, a relation or a bound, which must be a scalar (QDOT_ETYPE otherwise); stops before = == < <= > >=
 * and or. */
QDOT_MUST_CHECK qdot_status qdot_read_scalar(qdot_cursor *c, qdot_expr *value);
/* A name to be declared or a label, with its indices evaluated: "theta[1]", "A[1,2]". The string is in
 * the source's arena. */
QDOT_MUST_CHECK qdot_status qdot_read_name(qdot_cursor *c, const char **name);
/* Find the order-th time derivative of the coordinate of that name; `start` is where an error is shown. */
QDOT_MUST_CHECK qdot_status qdot_read_jet_of(qdot_cursor *c, const qdot_token *start,
                                             const char *name, uint32_t order, qdot_expr *jet);

#endif
