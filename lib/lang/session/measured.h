/* measured.h -- numbers from runs: a symbol represents each in expressions. */
#ifndef QDOT_LANG_MEASURED_H
#define QDOT_LANG_MEASURED_H

#include "lang/session/session.h"

/* A new symbol for a result of a run; nil on failure, which the pool keeps. */
qdot_expr qdot_measured_new(qdot_session *session, double value, double error);
qdot_expr qdot_measured_add(qdot_session *session, qdot_measured m);
/* Whether e contains a number from a run. */
bool qdot_measured_occurs(qdot_session *session, qdot_expr e);
/* e with the results of runs in it replaced by exact rationals. */
qdot_expr qdot_measured_as_rationals(qdot_session *session, qdot_expr e);
/* A double as the rational number that it is exactly. */
qdot_expr qdot_measured_rational(qdot_pool *pool, double x);

#endif
