/* cells-closure.h -- of which weak conditions all points are limits of points inside, for cells.c alone.
 *
 * Tests  tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_CELLS_CLOSURE_H
#define QDOT_NORMAL_CELLS_CLOSURE_H

#include "normal/field/field.h"

/* Whether g is linear: the solutions of several linear g >= 0 are the closure of their interior,
 * unless that is empty. */
bool qdot_gap_is_linear(qdot_field *f, qdot_expr g);

/* Whether g grows, or falls, with a symbol that stands in no other weak condition [n] and in the base of no root: where
 * g = 0, points with g > 0 that change the others by nothing lie as near as one likes. */
bool qdot_gap_grows_alone(qdot_field *f, qdot_expr g, size_t n, const qdot_expr *weak);

/* Whether the field contains only symbols, roots and absolute values. */
bool qdot_field_is_algebraic(const qdot_field *f);

#endif
