/* write.h -- formulas as text: a writer for each language.
 *
 * A tree for a script or a line is written by the first function, one that is drawn by the others.
 *
 * Tests  tests/formula/test_write.c
 */
#ifndef QDOT_FORMULA_WRITE_H
#define QDOT_FORMULA_WRITE_H

#include "formula/formula.h"

/* Append the node as one line, in the notation QDOT_NOTATION_SCRIPT or QDOT_NOTATION_LINE. Errors:
 * QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_formula_write_line(const qdot_formula *f, qdot_formula_id id,
                                                    qdot_notation_kind notation, qdot_text *out);

/* What stands before a node in its row: a sign and what the sign follows; 0: nothing. */
typedef struct {
    qdot_formula_id sign, factor;
} qdot_formula_before;

/* The nodes that stand before part i of a row: a sign, and what precedes the sign. */
static inline qdot_formula_before
qdot_formula_before_part(const qdot_formula_parts *parts, size_t i)
{
    return (qdot_formula_before){i > 0 ? parts->part.at[i - 1] : 0, i > 1 ? parts->part.at[i - 2] : 0};
}

/* Write a formula in LaTeX, for its mathematics mode. A thin space stands between two names of several letters, mass and
 * length, which would be read as one. */
QDOT_MUST_CHECK qdot_status qdot_formula_write_latex(const qdot_formula *f, qdot_formula_id id, qdot_text *out);
/* As qdot_formula_write_latex, for one node of a row, given what stands before it in the row. */
QDOT_MUST_CHECK qdot_status qdot_formula_write_latex_part(const qdot_formula *f, qdot_formula_id id,
                                                          qdot_formula_before before, qdot_text *out);

/* Write a drawn formula as gnuplot's enhanced text: indices, powers and dots stand where they belong, fractions in a
 * line, a/(b·c). */
QDOT_MUST_CHECK qdot_status qdot_formula_write_gnuplot(const qdot_formula *f, qdot_formula_id id, qdot_text *out);

/* Write a formula in presentation MathML, the contents of <math>. */
QDOT_MUST_CHECK qdot_status qdot_formula_write_mathml(const qdot_formula *f, qdot_formula_id id, qdot_text *out);

/* The same for a page: an index and a power stand one above the other, round brackets about one line do not stretch
 * (browsers leave room for the widest form of one that does), and a thin space stands between a factor and a function
 * of several letters, as in L cos u, and between two names of several letters. */
QDOT_MUST_CHECK qdot_status qdot_formula_write_page(const qdot_formula *f, qdot_formula_id id,
                                                    qdot_formula_before before, qdot_text *out);

/* The tags at the two ends of a MathML formula in a text. */
#define QDOT_FORMULA_MATH "<math xmlns=\"http://www.w3.org/1998/Math/MathML\">"
#define QDOT_FORMULA_MATH_END "</math>"

/* Append HTML text, with & and < as entities. */
void qdot_formula_escape(const char *text, size_t n, qdot_text *out);

#endif
