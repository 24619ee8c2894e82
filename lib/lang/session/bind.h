/* bind.h -- evaluates expressions to numbers, with the values given by `set` and the numbers from runs. */
#ifndef QDOT_LANG_BIND_H
#define QDOT_LANG_BIND_H

#include "lang/session/parts.h"

/* e with the values of parameters (`set`, `param x = v`) put in; exact. Repeated, as values may
 * hold other parameters; a cycle is QDOT_EINVAL. */
qdot_expr qdot_session_bind(qdot_session *session, qdot_expr e);
/* Evaluate e as a double, with the session's values and the results of runs; the error (may be
 * NULL) is propagated from theirs. */
QDOT_MUST_CHECK qdot_status qdot_session_number(qdot_session *session, qdot_expr e,
                                                double *value, double *error);
/* As qdot_session_number; *low is the exact value minus the double, 0 if e contains results of runs. */
QDOT_MUST_CHECK qdot_status qdot_session_split(qdot_session *session, qdot_expr e,
                                               double *value, double *low);
/* Evaluate e as an integer; QDOT_ETYPE, with the value in the message, if it is no integer. */
QDOT_MUST_CHECK qdot_status qdot_session_integer(qdot_session *session, qdot_expr e,
                                                 int64_t *value);
/* QDOT_EDOMAIN where the value is a number already and lies outside the symbol's
 * domain. */
QDOT_MUST_CHECK qdot_status qdot_session_in_domain(qdot_session *session,
                                                   qdot_expr symbol, qdot_expr value);

#endif
