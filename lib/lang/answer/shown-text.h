/* shown-text.h -- what a person reads of an answer, as fields of its object of JSON:
 *
 *     "text"     lines of text as the prompt prints them, in Unicode
 *     "html"     a part of a page: text escaped, formulas in MathML, classes of qdot_shown_style and no style
 *     "typeset"  an answer of one line: {"latex": ..., "mathml": ..., "unicode": ...} (shown.h)
 *     "cells"    the cells of a row of a table
 *
 * Tests  tests/api/test_display.c
 */
#ifndef QDOT_LANG_SHOWN_TEXT_H
#define QDOT_LANG_SHOWN_TEXT_H

#include "base/text.h"

/* Append "text" and "html", the same text in <pre class="CLASS">. */
void qdot_shown_text(const char *class, const char *text, qdot_text *object);

/* Append "text", without newlines at its end, and "html". */
void qdot_shown_fields(const char *text, const char *html, qdot_text *object);

/* A row of a table while its cells are appended. */
typedef struct {
    qdot_text list, text, html; /* the cells as an array of JSON, as text, as HTML */
    const char *tag;            /* "th" or "td" */
} qdot_shown_row;

/* _begin: a row of heads or not; _cell: append a cell of words or of a number; _end: append "cells", "text", "html", and
 * free the row. */
qdot_shown_row qdot_shown_row_begin(bool heads);
void qdot_shown_cell(qdot_shown_row *row, const char *cell, bool words);
void qdot_shown_row_end(qdot_shown_row *row, qdot_text *object);

/* How the classes of "html" look, as CSS: what is within an element of the class `qdot`. */
extern const char qdot_shown_style[];

#endif
