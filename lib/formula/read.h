/* read.h -- formulas as they are typed, read into a tree: labels of figures.
 *
 *     theta1' - m*l^2/2     drawn: ACCENT and INDEX of theta, SIGN minus, FRACTION(m l^2, 2)
 *
 * What was typed is shown, not what it means: nothing is looked up, evaluated or put in order. Any text can be read;
 * what is no formula stands as it was typed.
 *
 * Tests  tests/formula/test_read.c
 */
#ifndef QDOT_FORMULA_READ_H
#define QDOT_FORMULA_READ_H

#include "formula/formula.h"

/* Append the formula, for a line or drawn, to the parent. In a line the brackets that were typed stay; drawn fractions,
 * roots and exponents need none. */
void qdot_formula_read(qdot_formula *f, qdot_formula_id parent, const char *typed, qdot_notation_kind notation);

#endif
