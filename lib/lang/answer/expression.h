/* expression.h -- values of a session as formulas and as text: a series by its degree, none that is too large. */
#ifndef QDOT_LANG_EXPRESSION_H
#define QDOT_LANG_EXPRESSION_H

#include "formula/formula.h"
#include "lang/session/session.h"

#define QDOT_EXPRESSION_OPERATIONS 10000000u /* the largest expression that is printed */

/* Append e as a child of the parent. QDOT_ELIMIT, before any work: more than QDOT_EXPRESSION_OPERATIONS. */
QDOT_MUST_CHECK qdot_status qdot_expression_add(qdot_session *session, qdot_expr e, qdot_notation_kind notation,
                                                qdot_formula *f, qdot_formula_id parent);

/* Append e as text. The same errors. */
QDOT_MUST_CHECK qdot_status qdot_expression_print(qdot_session *session, qdot_expr e, qdot_style style,
                                                  qdot_text *out);

#endif
