/* notation.h -- formulas of books in words of answers: "Q = sum F.dr/dq - dV/dq" in a style.
 *
 *   sum  1/2  lambda  omega  deltaW     Σ ½ λ ω δW
 *   dV/dq  d/dt  dT/dq'                 ∂V/∂q d/dt ∂T/∂q̇, fractions in LaTeX and MathML
 *   q''  v^2  .  -                      q̈ v² · −
 *
 * Tests  tests/lang/answer/test_notation.c
 */
#ifndef QDOT_LANG_NOTATION_H
#define QDOT_LANG_NOTATION_H

#include "expr/print-name.h"

/* Append the formula; plain: as it stands. Of a page without its marks. */
void qdot_notation(const char *formula, qdot_style style, qdot_text *out);

/* Append numerator over denominator, each written in the style already: as a fraction in LaTeX and
 * MathML, else with a slash. */
void qdot_notation_over(const char *up, const char *down, qdot_style style,
                        qdot_text *out);

#endif
