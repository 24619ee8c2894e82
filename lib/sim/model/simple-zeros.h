/* simple-zeros.h -- a function that vanishes where g does, and as steeply as it can.
 *
 *     (x - 1)^7        x - 1            its zero is known to a double, not to its 7th root
 *     (x - 1)^4 y^3    (x - 1)^2 y      of the same sign as g
 *     (x - 1)^4 y^2    (x - 1) y        where no sign is asked for: g only touches 0
 *
 * A high power also underflows far from its zero, (x - 1)^10000 in all of 0.1 < x < 1.9.
 *
 * Tests  tests/sim/model/test_simple-zeros.c, tests/script/events/event-powers.lag
 */
#ifndef QDOT_SIM_SIMPLE_ZEROS_H
#define QDOT_SIM_SIMPLE_ZEROS_H

#include "expr/id.h"

/* The factors of g with exponent 1 in place of an odd one, 2 in place of an even one, -1 and -2 of
 * poles; others as they are. A number far from 1, in all terms, is divided out. Nil absorbs. */
qdot_expr qdot_simple_zeros(qdot_pool *pool, qdot_expr g);

/* The function u if g is c u^2, |u|, or a product of such factors, so that g never changes its
 * sign; otherwise nil. */
qdot_expr qdot_touching_zeros(qdot_pool *pool, qdot_expr g);

#endif
