/* terms.h -- the terms of a sum by the symbols that they hold.
 *
 * Tests  tests/mech/study/test_rods.c
 */
#ifndef QDOT_MECH_TERMS_H
#define QDOT_MECH_TERMS_H

#include <stdbool.h>
#include <stddef.h>

#include "expr/id.h"

/* Of a number or vector, component by component: the sum of the terms that hold one of symbols [n]
 * (holding), or of those that hold none. */
qdot_expr qdot_mech_terms_of(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *symbols,
                             bool holding);

#endif
