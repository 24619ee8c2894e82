/* equilibria.h -- equilibria and modes of a session's scene, with its values for numbers. */
#ifndef QDOT_LANG_EQUILIBRIA_H
#define QDOT_LANG_EQUILIBRIA_H

#include "lang/session/session.h"
#include "mech/study/equilibrium.h"
#include "mech/study/modes.h"

/* As qdot_equilibrium_find, with the values of `set`. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_find(qdot_session *session,
                                                 qdot_equilibria *out);
/* A LIST of their LISTs of equations; a band's has the relations of its range too. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_list(qdot_session *session,
                                                 const qdot_equilibria *all,
                                                 qdot_expr *value);
/* The LIST of one of them. */
qdot_expr qdot_equilibria_value(qdot_pool *pool, const qdot_equilibrium *e);
/* The k-th is used as a value: tell its conditions, unless the values of the session fulfil them. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_notice(qdot_session *session, long k, const qdot_equilibrium *e);
/* The verdict on one, such a LIST, as a value: a word, or if(CONDITION, word, undecided). */
QDOT_MUST_CHECK qdot_status qdot_equilibria_stability(qdot_session *session,
                                                      qdot_expr equations,
                                                      qdot_expr *value);
/* The word of a verdict, as people write it in a check. */
qdot_expr qdot_equilibria_word(qdot_pool *pool, qdot_stability stability);
bool qdot_equilibria_is_word(qdot_pool *pool, qdot_expr e);
/* The modes there; nil: about the first equilibrium that is not unstable. A notice tells a place that exists, or is stable,
 * under conditions, unless the values of the session fulfil these. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_modes_at(qdot_session *session,
                                                     qdot_expr equations,
                                                     qdot_modes *modes);

#endif
