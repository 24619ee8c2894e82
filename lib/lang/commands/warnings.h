/* warnings.h -- notices for statements that are allowed but often mistakes. */
#ifndef QDOT_LANG_WARNINGS_H
#define QDOT_LANG_WARNINGS_H

#include "lang/language/cursor.h"

/* NAME = EXPR where the language has a meaning for NAME: which statement would enter the
 * equations of motion, and how the language's value is reached now. start: the token of the
 * name; the statement ends at c->at. */
QDOT_MUST_CHECK qdot_status qdot_warnings_definition(qdot_cursor *c,
                                                     const qdot_token *start,
                                                     const qdot_name *entry);
/* A value in place of a function, or a function in place of a value, before it is declared. */
QDOT_MUST_CHECK qdot_status qdot_warnings_anew(qdot_session *session, const qdot_name *entry);
/* A potential, spring, force ... that was declared before in the same words, after it was added. */
QDOT_MUST_CHECK qdot_status qdot_warnings_twice(qdot_session *session,
                                                qdot_scene_kind kind);
/* A force at a place that moves within a body. body: it was written point(body, ...); NULL. The
 * tokens [action, at) are the force, those behind `at` up to c->at the place. */
QDOT_MUST_CHECK qdot_status qdot_warnings_place(qdot_cursor *c, qdot_expr place,
                                                const char *body,
                                                const qdot_token *action,
                                                const qdot_token *at);
/* A run without any `start`. */
QDOT_MUST_CHECK qdot_status qdot_warnings_start(qdot_session *session);

/* A particle or body of that name whose mass holds the time: what its equations assume, as a notice. */
QDOT_MUST_CHECK qdot_status qdot_warnings_mass(qdot_session *session, const char *name, qdot_expr mass);

#endif
