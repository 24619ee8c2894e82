/* equilibria.h -- equilibria and modes of a session's scene, with its values for numbers. */
#ifndef QDOT_LANG_EQUILIBRIA_H
#define QDOT_LANG_EQUILIBRIA_H

#include "lang/session.h"
#include "mech/equilibrium.h"

/* As qdot_equilibrium_find, with the values of `set`. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_find(qdot_session *session,
                                                 qdot_equilibrium **list, size_t *n);
/* A LIST of their LISTs of equations. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_list(qdot_session *session,
                                                 const qdot_equilibrium *list, size_t n,
                                                 qdot_expr *value);
/* The modes there; nil: about the first equilibrium that is not unstable. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_modes_at(qdot_session *session,
                                                     qdot_expr equations,
                                                     qdot_modes *modes);

#endif
