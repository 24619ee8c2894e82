/* formula-page.h -- answers as a LaTeX fragment or as an HTML page with MathML.
 *
 * The answers are lines of text in which formulas are marked: \( ... \) in LaTeX, <math> ... </math>
 * in MathML. Lines that are one formula each form a block, aligned at their first = sign; what is
 * wider than a line of print is broken before + and - signs outside brackets. A name before a colon
 * (`eom[theta]: `) becomes a comment in LaTeX, a label beside the equation in HTML. All other lines
 * are text with formulas in it; a line "3. Title" is a heading.
 *
 * The LaTeX is a fragment to be included (\input), which needs the package amsmath.
 *
 * Tests  tests/show/test_formula-page.c, tests/script/files/formula-file.sh
 */
#ifndef QDOT_SHOW_FORMULA_PAGE_H
#define QDOT_SHOW_FORMULA_PAGE_H

#include "base/text.h"

/* Append the fragment. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_page_latex(const char *answers, qdot_text *out);

/* Append the body of a page: blocks and paragraphs. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_page_mathml(const char *answers, qdot_text *out);

/* The rules of CSS that the body needs, without <style>. */
extern const char qdot_page_css[];

/* Append a whole page: head with the title, style, body. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_page_html(const char *title, const char *answers,
                                           qdot_text *out);

#endif
