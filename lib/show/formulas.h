/* formulas.h -- what a page with MathML carries for browsers without a font for it.
 *
 * Without a font for mathematics Chromium shows boxes for letters and leaves brackets and roots as
 * high as a letter. The program sets the letters as italics of the text and draws brackets and
 * roots as lines, where it finds that they do not grow; with such a font it changes nothing.
 */
#ifndef QDOT_SHOW_FORMULAS_H
#define QDOT_SHOW_FORMULAS_H

#include "base/text.h"

/* Append the script lib/show/formulas.js to a page; it must come after the formulas. */
void qdot_formulas_foot(qdot_text *out);

#endif
