/* value-check.h -- checks values of parameters and functions: a rest length must not be negative,
 * an assumption not false. Expressions with parameters that have no value are not checked. */
#ifndef QDOT_LANG_VALUE_CHECK_H
#define QDOT_LANG_VALUE_CHECK_H

#include "lang/commands/pairs.h"
#include "lang/language/cursor.h"
#include "mech/scene/things.h"

/* QDOT_EINVAL where a rest length, with the values of `set` put in, is a negative number; names the
 * spring (NULL: one without a name). Tests: tests/bad/rests/rest-negative*.lag. */
QDOT_MUST_CHECK qdot_status qdot_value_check_rest(qdot_session *session,
                                                  const char *spring, qdot_expr rest);

/* QDOT_EINVAL where what is assumed is false with the values of `set` put in. Tests:
 * tests/bad/prove/assumed-*.lag. */
QDOT_MUST_CHECK qdot_status qdot_value_check_assumption(qdot_session *session,
                                                        const qdot_assumption *said);

/* All rest lengths and assumptions of the scene, as they would be if these values were set too;
 * c->error_at is then the place of the value that is to blame. */
QDOT_MUST_CHECK qdot_status qdot_value_check(qdot_cursor *c, const qdot_pairs *values);

/* Check, before a run, that the values given by `set` satisfy every assumption. */
QDOT_MUST_CHECK qdot_status qdot_value_check_assumed(qdot_session *session);

#endif
