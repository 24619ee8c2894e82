/* formula.h -- expressions and the names of answers in the style of the session. */
#ifndef QDOT_LANG_FORMULA_H
#define QDOT_LANG_FORMULA_H

#include "lang/session/session.h"

#define QDOT_FORMULA_OPERATIONS 10000000u /* the largest expression that is printed */

/* Append e. QDOT_ELIMIT, before any work: more than QDOT_FORMULA_OPERATIONS. */
QDOT_MUST_CHECK qdot_status qdot_formula_print(qdot_session *session, qdot_expr e,
                                               qdot_style style, qdot_text *out);

/* Append the name of an answer in the style of the session: eom[θ₁], \mathrm{eom}_{\theta}. */
QDOT_MUST_CHECK qdot_status qdot_formula_name(qdot_session *session, const char *name,
                                              qdot_text *out);
/* Append e in the style of the session, as a formula within a text: MathML inside <math>. */
QDOT_MUST_CHECK qdot_status qdot_formula_marked(qdot_session *session, qdot_expr e,
                                         qdot_text *out);
/* The same by parts: what begins and ends a formula, and the sign = between two. */
void qdot_formula_bracket(const qdot_session *session, bool open, qdot_text *out);
const char *qdot_formula_equals(const qdot_session *session);

#endif
