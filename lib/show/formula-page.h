/* formula-page.h -- lines of answers as a LaTeX fragment, as an HTML page with MathML, as a part of a report.
 *
 * A line is a node whose children are texts (WORDS, as they were typed) and formulas (SPAN). Lines that are one formula
 * each form a block, aligned at their first = sign; what is wider than a line of print is broken before + and - signs
 * outside brackets. A name before a colon (`eom[theta]: `) becomes a comment in LaTeX, a label beside the equation in
 * HTML. All other lines are text with formulas in it; a line "3. Title" is a heading.
 *
 * The LaTeX is a fragment to be included (\input), which needs the package amsmath. A report (show/page.h) has a
 * paragraph for each line.
 *
 * Tests  tests/show/test_formula-page.c, tests/script/files/formula-file.sh
 */
#ifndef QDOT_SHOW_FORMULA_PAGE_H
#define QDOT_SHOW_FORMULA_PAGE_H

#include "base/text.h"
#include "formula/formula.h"

typedef enum { QDOT_PAGE_LATEX, QDOT_PAGE_MATHML, QDOT_PAGE_REPORT } qdot_page_kind;

/* A part of a formula: its byte position, the width of the text before it, and its role in the row. */
typedef struct {
    size_t at, width;
    qdot_formula_duty duty;
} qdot_page_cut;

/* Start with `qdot_formula_page p = {.kind = ...};`, free with qdot_formula_page_clear. */
typedef struct qdot_formula_page {
    qdot_page_kind kind;
    const char *paint, *end; /* colour codes before and after the names of answers; NULL: none */
    qdot_text out;
    qdot_status status; /* the first failure, after which nothing is written */
    bool block;         /* a block of equations is open */
    bool told;          /* the last row of the open block has been ended by the words after it */
    qdot_text label;    /* the answer's name that is written before the next row in LaTeX */
    qdot_text written;  /* scratch: LaTeX or MathML of the formula being written and its parts */
    qdot_formula_parts parts;
    qdot_vec(qdot_page_cut) cuts; /* position of each part in `written`; the last entry is the end of the text */
} qdot_formula_page;

void qdot_formula_page_clear(qdot_formula_page *page);

/* Append a line whose formulas are in the notation QDOT_NOTATION_DRAWN. */
void qdot_formula_page_line(qdot_formula_page *page, const qdot_formula *f, qdot_formula_id line);
/* Append lines of plain text, without formulas. */
void qdot_formula_page_text(qdot_formula_page *page, const char *lines, size_t n);

/* Append the contents of the page to `out`, without head or body tags. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_formula_page_end(qdot_formula_page *page, qdot_text *out);

/* Like qdot_formula_page_end, but write a whole HTML page: head with title and style, then body. */
QDOT_MUST_CHECK qdot_status qdot_formula_page_html(qdot_formula_page *page, const char *title, qdot_text *out);

#endif
