/* notation.h -- formulas of books in words of answers, as formulas: "Q = sum F.dr/dq - dV/dq".
 *
 *   sum  1/2  lambda  omega  deltaW     Σ ½ λ ω δW
 *   dV/dq  d/dt  dT/dq'                 ∂V/∂q d/dt ∂T/∂q̇, fractions where they are drawn
 *   q''  v^2  .  -                      q̈ v² · −
 *
 * Tests  tests/lang/answer/test_notation.c
 */
#ifndef QDOT_LANG_NOTATION_H
#define QDOT_LANG_NOTATION_H

#include "formula/formula.h"

/* Append a formula given in this notation to the tree; for a script it is copied as text. */
void qdot_notation_add(qdot_formula *f, qdot_formula_id parent, const char *formula, qdot_notation_kind notation);

/* Print a formula given in this notation as one line, for a script (unchanged) or for the eye. */
void qdot_notation_print(const char *formula, qdot_notation_kind notation, qdot_text *out);

#endif
