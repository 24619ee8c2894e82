/* equilibria.h -- finds equilibria and modes of a scene; numerical ones with the session's parameter values. */
#ifndef QDOT_LANG_EQUILIBRIA_H
#define QDOT_LANG_EQUILIBRIA_H

#include "lang/session/parts.h"
#include "mech/study/equilibrium.h"
#include "mech/linear/modes.h"

typedef qdot_status qdot_equilibria_search(qdot_session *session, qdot_equilibria *out);

/* As qdot_equilibrium_find, with the parameter values given by `set`. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_find(qdot_session *session,
                                                 qdot_equilibria *out);
/* As qdot_steady_find, with the parameter values given by `set`. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_steady(qdot_session *session, qdot_equilibria *out);
/* Make the LIST of all equilibria, each a LIST of equations; a continuous set of them also has its range. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_list(qdot_session *session,
                                                 const qdot_equilibria *all,
                                                 qdot_expr *value);
/* One equilibrium as a LIST of its equations. */
qdot_expr qdot_equilibria_value(qdot_pool *pool, const qdot_equilibrium *e);
/* When equilibrium k is used as a value: give a notice of its conditions, unless the session's values satisfy them. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_notice(qdot_session *session, const char *word, int64_t k,
                                                   const qdot_equilibrium *e);
/* Find the stability of one equilibrium, given as a LIST of equations: a word, or if(CONDITION,
 * word, undecided). */
QDOT_MUST_CHECK qdot_status qdot_equilibria_stability(qdot_session *session,
                                                      qdot_expr equations,
                                                      qdot_expr *value);
/* _word: a stability verdict as the word that a user writes in a check; the other: whether e is such a word. */
qdot_expr qdot_equilibria_word(qdot_pool *pool, qdot_stability stability);
bool qdot_equilibria_is_word(qdot_pool *pool, qdot_expr e);
/* The modes there; nil: about the first equilibrium that is not unstable. A notice tells a place that exists, or is stable,
 * under conditions, unless the values of the session fulfil these. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_modes_at(qdot_session *session,
                                                     qdot_expr equations,
                                                     qdot_modes *modes);

#endif
