/* expression.h -- prints values as formulas and as text: series by increasing degree; of too large
 * ones only the size. */
#ifndef QDOT_LANG_EXPRESSION_H
#define QDOT_LANG_EXPRESSION_H

#include "expr/print-name.h"
#include "formula/formula.h"
#include "lang/session/parts.h"

#define QDOT_EXPRESSION_OPERATIONS 10000000u /* largest number of operations in an expression that is printed */

/* Append e as a child of a formula node. QDOT_ELIMIT if it has more than QDOT_EXPRESSION_OPERATIONS. */
QDOT_MUST_CHECK qdot_status qdot_expression_add(qdot_session *session, qdot_expr e, qdot_notation_kind notation,
                                                qdot_formula *f, qdot_formula_id parent);

/* Append e as text in that style. Errors: as for qdot_expression_add. */
QDOT_MUST_CHECK qdot_status qdot_expression_print(qdot_session *session, qdot_expr e, qdot_style style,
                                                  qdot_text *out);

/* Append e as an array of JSON (lang/answer/print-tree.h). Errors: of it, and as for qdot_expression_add. */
QDOT_MUST_CHECK qdot_status qdot_expression_tree(qdot_session *session, qdot_expr e, qdot_text *out);

#endif
