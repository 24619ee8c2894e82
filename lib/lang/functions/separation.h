/* separation.h -- the separation of the scene's equation of Hamilton and Jacobi, with names for its constants that the
 * session does not use otherwise. A declared parameter of such a name is that constant, a declared function S(q, t) the solution.
 *
 * Tests  tests/script/studies/hamilton-jacobi.lag, action.lag
 */
#ifndef QDOT_LANG_SEPARATION_H
#define QDOT_LANG_SEPARATION_H

#include "lang/session/parts.h"
#include "mech/hamilton/separation.h"

/* As qdot_separation_find. */
QDOT_MUST_CHECK qdot_status qdot_session_separate(qdot_session *session, qdot_expr energy, qdot_separation *out);
/* As qdot_separation_equation. */
QDOT_MUST_CHECK qdot_status qdot_session_jacobi_equation(qdot_session *session, qdot_expr H, qdot_expr *equation);

/* The values `hamilton_jacobi`, `hamilton_jacobi[q]`, `complete_integral`. */
QDOT_MUST_CHECK qdot_status qdot_session_get_jacobi(qdot_session *session, uint32_t n, const qdot_expr *index, qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_session_get_integral(qdot_session *session, uint32_t n, const qdot_expr *index, qdot_expr *value);

#endif
