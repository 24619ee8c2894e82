/* measured.h -- numbers from runs: a symbol represents each in expressions. */
#ifndef QDOT_LANG_MEASURED_H
#define QDOT_LANG_MEASURED_H

#include "lang/session/session.h"

/* A new symbol for a number of a run; nil on failure, which the pool keeps. */
qdot_expr qdot_measured_new(qdot_session *session, double value, double error);
qdot_expr qdot_measured_add(qdot_session *session, qdot_measured m);
/* Whether e contains a number from a run. */
bool qdot_measured_occurs(qdot_session *session, qdot_expr e);
/* e with the numbers of runs in it as the rationals that they are. */
qdot_expr qdot_measured_as_rationals(qdot_session *session, qdot_expr e);
/* A double as the exact rational it is. */
qdot_expr qdot_measured_rational(qdot_pool *pool, double x);

#endif
