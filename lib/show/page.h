/* page.h -- answers as parts of a page: headings and formulas.
 *
 * Tests  tests/show/test_page.c, tests/script/files/report.sh
 */
#ifndef QDOT_SHOW_PAGE_H
#define QDOT_SHOW_PAGE_H

#include "base/text.h"
#include "formula/formula.h"

/* Append the head of a page with its style and title (plain text); append its end. */
void qdot_page_begin(qdot_text *out, const char *title);
void qdot_page_end(qdot_text *out);

/* Append a line of an answer, as show/formula-page.h has it. `12. Title` is a heading; a line set in by blanks, or that
 * begins with a formula, is a formula; another line is a paragraph. A formula is divided before +, - and = outside
 * brackets, so that a browser may break its line there. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_page_line(qdot_text *out, const qdot_formula *f, qdot_formula_id line);

/* Whether a line's first text begins like the heading `12. Title`; more: something follows this text. */
bool qdot_page_is_heading(const char *text, bool more);

/* Append text unchanged in a monospaced font. */
void qdot_page_verbatim(qdot_text *out, const char *text);

#endif
