/* page.h -- answers as parts of a page: headings and formulas.
 *
 * Tests  tests/show/test_page.c, tests/script/files/report.sh
 */
#ifndef QDOT_SHOW_PAGE_H
#define QDOT_SHOW_PAGE_H

#include "base/text.h"

/* Append what stands before the first section, with the style of the page; title: text. */
void qdot_page_begin(qdot_text *out, const char *title);
void qdot_page_end(qdot_text *out);

/* Append lines of an answer in the style mathml. `12. Title` is a heading, a line set in by
 * blanks a formula, another line a paragraph. Within them MathML stays MathML; the rest is text.
 * A formula is divided at the top level before +, - and =, so that a browser breaks its line there. */
void qdot_page_lines(qdot_text *out, const char *lines);

/* Append text as it stands, in equally wide letters. */
void qdot_page_verbatim(qdot_text *out, const char *text);

#endif
