/* declare.h -- what several statements need to declare names and give them values. */
#ifndef QDOT_LANG_DECLARE_H
#define QDOT_LANG_DECLARE_H

#include "lang/language/read.h"

/* Declare an entry whose name stands at `start`; file and line are filled in. A notice
 * is given where it hides a value of the language. */
QDOT_MUST_CHECK qdot_status qdot_declare_name(qdot_cursor *c, const qdot_token *start,
                                              qdot_name *entry);

/* From now on the symbol (a parameter, a momentum) or undefined function (applied to
 * formal symbols that stand in `value`) has this value for numbers. *status:
 * QDOT_ENOMEM. */
void qdot_declare_value(qdot_session *session, qdot_expr symbol, qdot_expr value,
                        qdot_status *status);

/* QDOT_EDOMAIN where the value is a number already and lies outside the symbol's
 * domain. */
QDOT_MUST_CHECK qdot_status qdot_declare_in_domain(qdot_session *session,
                                                   qdot_expr symbol, qdot_expr value);

/* A name is declared that stands as an argument in `function x(NAME)` before: that function is
 * from now on one of the symbol. */
QDOT_MUST_CHECK qdot_status qdot_declare_meet_functions(qdot_session *session,
                                                        const char *name,
                                                        qdot_expr symbol);

/* `(u, v)`: a LIST of FORMAL symbols, and the tokens [*n] of their names, owned by the
 * caller. */
QDOT_MUST_CHECK qdot_status qdot_declare_read_formals(qdot_cursor *c, qdot_expr *formals,
                                                      const qdot_token ***names,
                                                      size_t *n);
/* An expression in which these names mean these values. */
QDOT_MUST_CHECK qdot_status qdot_declare_read_body(qdot_cursor *c, qdot_expr formals,
                                                   size_t n,
                                                   const qdot_token *const *names,
                                                   qdot_expr *body);

#endif
