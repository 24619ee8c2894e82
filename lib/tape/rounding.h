/* rounding.h -- what rounding makes of the values of a tape.
 *
 * An operation d = op(a, b, c) adds its own rounding to what it makes of those of its operands,
 *
 *     e_d^2 = sum_k (dd/da_k e_k)^2 + (w u d)^2,   u = 2^-53,
 *
 * w = 0 if it is exact, as a sign is, 2 of hyperbolic functions and some others, else 1; a product within an
 * operation, as of a b + c, adds u a b; one that is below the least normal double adds 2^-1074. e of a constant is known, inputs have none. Errors of different operations count as independent of each other.
 *
 * Two runs from starts a rounding apart do not show that error where the operands hardly know of
 * the inputs: cos(x) - 1 at x = 1e-5 is off by 1e-16 in both. Such a result is one with
 *
 *     e_d > 8 max(|dd/dx . x| u, u |d|),   e_d > 1.5 |dd/dc . s|,
 *
 * x the inputs, s by how much constants c are shaken (tape/shake.h). To make it visible its operands a_k are multiplied by 1, whose other neighbour
 * is some doubles away: in a shaken tape a_k is off by e_k, all to one side of d.
 *
 * Source  Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), 3.3
 * Tests   tests/tape/test_rounding.c, tests/script/contacts/cancelling-forces.sh
 */
#ifndef QDOT_TAPE_ROUNDING_H
#define QDOT_TAPE_ROUNDING_H

#include "tape/tape.h"

/* What the outputs d at in [inputs] may be off by: bounds [outputs] = 2 max(e_d, u |d|), without an e_d
 * that is not finite; work [2 qdot_tape_work]. of_in [inputs]: e of these; NULL: none. */
void qdot_rounding_bounds(const qdot_tape *tape, const double *in, const double *of_in, double *bounds,
                          double *work);

/* What underflow alone makes of the outputs: bounds [outputs] = e_d for u = 0, which may be infinite or a NaN; work
 * [2 qdot_tape_work]. */
void qdot_rounding_underflows(const qdot_tape *tape, const double *in, double *bounds, double *work);

/* Multiply operands as above, wherever a result is such at one of some states: all inputs small,
 * all large, some of them small. What the tape evaluates to stays the same. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_rounding_show(qdot_tape *tape);

#endif
