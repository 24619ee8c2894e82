/* warnings.h -- notices for statements that are allowed but often mistakes. */
#ifndef QDOT_LANG_WARNINGS_H
#define QDOT_LANG_WARNINGS_H

#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/source/token.h"
#include "mech/scene/things.h"

/* NAME = EXPR where the language has a meaning for NAME: which statement would enter the
 * equations of motion, and how the language's value is reached now. start: the token of the
 * name; the statement ends at c->at. */
QDOT_MUST_CHECK qdot_status qdot_warnings_definition(qdot_cursor *c,
                                                     const qdot_token *start,
                                                     const qdot_name *entry);
/* Notice before a value is redefined as a function, or a function as a value. */
QDOT_MUST_CHECK qdot_status qdot_warnings_anew(qdot_session *session, const qdot_name *entry);
/* Notice after a potential, spring, force ... was added that is identical to an earlier one. */
QDOT_MUST_CHECK qdot_status qdot_warnings_twice(qdot_session *session,
                                                qdot_scene_kind kind);
/* A force at a place that moves within a body. body: it was written point(body, ...); NULL. The
 * tokens [action, at) are the force, those behind `at` up to c->at the place. */
QDOT_MUST_CHECK qdot_status qdot_warnings_place(qdot_cursor *c, qdot_expr place,
                                                const char *body,
                                                const qdot_token *action,
                                                const qdot_token *at);
/* Notice for a run without any `start`. */
QDOT_MUST_CHECK qdot_status qdot_warnings_start(qdot_session *session);

/* Notice for a particle or body whose mass depends on time: what its equations assume. */
QDOT_MUST_CHECK qdot_status qdot_warnings_mass(qdot_session *session, const char *name, qdot_expr mass);

#endif
