/* name.h -- names as they are spelled, in formulas: theta1 is θ₁, omega_0 ω₀, A[1,2] A with 1, 2 below.
 *
 * Tests  tests/formula/test_name.c
 */
#ifndef QDOT_FORMULA_NAME_H
#define QDOT_FORMULA_NAME_H

#include "formula/formula.h"

/* The spelled name of the two-byte Greek letter at `letter`: "theta" for "θ"; NULL if it is none. */
const char *qdot_name_greek(const char *letter);

/* An index that consists of digits: x_1 or x[1]. */
typedef struct {
    size_t letters; /* number of letters before the subscript */
    const char *at; /* the digits of the index, such as 1 of x_1 */
    size_t n;
    bool brackets; /* whether the index is in brackets: x[1] */
} qdot_name_digits;

/* Whether the only index of a name is digits after `_` or in brackets, so that it may be written as x₁. */
bool qdot_name_index(const char *name, qdot_name_digits *index);

/* Append the name in a line, with dots or primes for a derivative: θ̇₁. lowered: index digits become subscripts. */
void qdot_name_line(const char *name, uint32_t order, bool lowered, qdot_text *out);

/* Whether a node begins with a name of several letters, which are no Greek ones: mass, mass_1, mass'^2; whether it ends
 * with one: not where an index or a power follows. */
bool qdot_name_is_long_at_begin(const qdot_formula *f, const qdot_formula_node *node);
bool qdot_name_is_long_at_end(const qdot_formula *f, const qdot_formula_node *node);

/* Append a name to the formula node `parent`, as it is drawn: with its index as a subscript, and dots or primes. */
void qdot_formula_add_name(qdot_formula *f, qdot_formula_id parent, const char *name, uint32_t order);

#endif
