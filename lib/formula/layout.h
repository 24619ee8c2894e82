/* layout.h -- formulas drawn with characters, as wide as a terminal.
 *
 *           2                                     ₂
 *      m θ̇ ₁       fractions built up, roots, superscripts and subscripts by their Unicode
 *      ─────       characters where there are some, raised and lowered where not; matrices
 *        2         with their columns aligned
 *
 * What is wider than the terminal is broken before = and signs, then between factors,
 * inside brackets only where it must be; the lines that follow are indented to what follows the
 * first =. No line is wider: names and numbers are cut where nothing else helps. Where the name of an
 * answer takes several lines, its value begins on a line of its own.
 *
 * Tests  tests/formula/test_layout.c
 */
#ifndef QDOT_FORMULA_LAYOUT_H
#define QDOT_FORMULA_LAYOUT_H

#include "base/text.h"
#include "formula/formula.h"

typedef struct {
    size_t columns, lines; /* number of columns and lines of what was drawn */
} qdot_layout_size;

typedef struct {
    size_t width;
    size_t shown;            /* largest number of lines drawn; further lines are only counted */
    const char *paint, *end; /* colour codes before and after the leading words and labels; NULL: none */
} qdot_layout_request;

/* Append the lines of a formula (QDOT_NOTATION_DRAWN), each with its end. *size grows by what there is. Errors:
 * QDOT_ENOMEM, QDOT_ELIMIT (too large), QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_layout_part(const qdot_formula *f, qdot_formula_id id,
                                             const qdot_layout_request *request, qdot_text *out,
                                             qdot_layout_size *size);

/* As qdot_layout_part, but shows all lines, without colour; size may be NULL. */
QDOT_MUST_CHECK qdot_status qdot_layout(const qdot_formula *f, qdot_formula_id id, size_t width, qdot_text *out,
                                        qdot_layout_size *size);

#endif
