/* print-formula.h -- expressions as formulas (formula/formula.h), which print.h has as text.
 *
 * Tests  tests/expr/test_print.c
 */
#ifndef QDOT_EXPR_PRINT_FORMULA_H
#define QDOT_EXPR_PRINT_FORMULA_H

#include "expr/print-name.h"
#include "formula/formula.h"

/* The notation in which formulas of this style are written: as input, as a line of text, or drawn (LaTeX, MathML ...). */
qdot_notation_kind qdot_print_notation(qdot_style style);

/* Append e as a child of the parent; `in` a LIST of symbols if it is a series in them, else nil. Errors: QDOT_EINVAL
 * (e is nil), QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_print_formula(const qdot_pool *pool, qdot_expr e, qdot_expr in,
                                               qdot_notation_kind notation, qdot_formula *out,
                                               qdot_formula_id parent);

/* Append a formula as text, in the notation of the style. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_print_written(const qdot_formula *f, qdot_formula_id id, qdot_style style,
                                               qdot_text *out);

#endif
