/* layout.h -- formulas drawn with characters, as wide as a terminal.
 *
 *           2                                     ₂
 *      m θ̇ ₁       fractions built up, roots, superscripts and subscripts by their Unicode
 *      ─────       characters where there are some, raised and lowered where not; matrices
 *        2         with their columns aligned
 *
 * The formula is presentation MathML as qdot_print writes it: one printer decides what is shown,
 * this how. What is wider than the terminal is broken before = and signs, then between factors,
 * inside brackets only where it must be; the lines that follow are indented to what follows the
 * first =. Never inside a number or a name: such a line is longer.
 *
 * Tests  tests/show/test_layout.c
 */
#ifndef QDOT_SHOW_LAYOUT_H
#define QDOT_SHOW_LAYOUT_H

#include "base/text.h"

typedef struct {
    size_t columns, lines; /* of what was drawn */
} qdot_layout_size;

typedef struct {
    size_t width;
    size_t shown;            /* lines that are drawn; those beyond are only counted */
    const char *paint, *end; /* codes of colour round words that the formula begins with and round <mrow
                                class="name">; NULL: none */
} qdot_layout_request;

/* Append the lines of a formula, each with its end; `mathml` what stands inside <math>. *size grows
 * by what there is. Errors: QDOT_EINVAL (not what the printer writes), QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_layout_part(const char *mathml, const qdot_layout_request *request,
                                             qdot_text *out, qdot_layout_size *size);

/* The same, all of it without colour; size may be NULL. */
QDOT_MUST_CHECK qdot_status qdot_layout(const char *mathml, size_t width, qdot_text *out,
                                        qdot_layout_size *size);

#endif
