/* warnings.h -- gives notices for statements that are allowed but often mistakes. */
#ifndef QDOT_LANG_WARNINGS_H
#define QDOT_LANG_WARNINGS_H

#include "lang/language/cursor.h"
#include "lang/session/names.h"
#include "lang/syntax/definition.h"
#include "mech/scene/things.h"

/* The language has a meaning for the new name: which statement would enter the equations of motion, and how the language's
 * value is reached now. definition: the statement, which ends at c->at; NULL: a statement with a word declares the name. */
QDOT_MUST_CHECK qdot_status qdot_warnings_definition(qdot_cursor *c, const qdot_definition *definition,
                                                     const qdot_name *entry);
/* Give a notice before a value is redefined as a function, or a function as a value. */
QDOT_MUST_CHECK qdot_status qdot_warnings_anew(qdot_session *session, const qdot_name *entry);
/* Give a notice after adding a potential, spring, force ... that is identical to an earlier one. */
QDOT_MUST_CHECK qdot_status qdot_warnings_twice(qdot_session *session,
                                                qdot_scene_kind kind);
/* A force at a place that moves within a body. body: it was written point(body, ...); NULL. The
 * tokens [action, at) are the force, those behind `at` up to c->at the place. */
QDOT_MUST_CHECK qdot_status qdot_warnings_place(qdot_cursor *c, qdot_expr place,
                                                const char *body,
                                                const qdot_token *action,
                                                const qdot_token *at);
/* Give a notice for a run without any `start` statement. */
QDOT_MUST_CHECK qdot_status qdot_warnings_start(qdot_session *session);

/* Give a notice of each input that is not among symbols [n] and counts as 0, though `set` gave it another value. */
QDOT_MUST_CHECK qdot_status qdot_warnings_inputs(qdot_session *session, size_t n, const qdot_expr *symbols);

/* Give a notice of what the equations assume about a particle or body whose mass depends on time. */
QDOT_MUST_CHECK qdot_status qdot_warnings_mass(qdot_session *session, const char *name, qdot_expr mass);

#endif
