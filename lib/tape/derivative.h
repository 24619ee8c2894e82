/* derivative.h -- exact derivatives of a tape, in forward mode.
 *
 * Every value of the tape carries its derivatives along QDOT_LANES directions; the rules are a
 * column of operation.def. J_ij = d out_i / d in_j costs about 3 operations for each operation
 * and column. No expression is differentiated.
 *
 * If an operation has no derivative (sqrt(0), the corner of an abs) the result is the derivative
 * of one side, or NaN or infinite by IEEE 754.
 *
 * Source  A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), 3.1: the vector
 *         forward mode.
 * Tests   tests/tape/test_derivative.c: symbolic derivatives, differences
 */
#ifndef QDOT_TAPE_DERIVATIVE_H
#define QDOT_TAPE_DERIVATIVE_H

#include "tape/tape.h"

/* The number of doubles that the derivatives of a tape need as work space. */
size_t qdot_derivative_work(const qdot_tape *tape);

/* out [m] = outputs at in [n], and J [m x columns] row-major, the derivatives of the
 * outputs by the inputs from ... from + columns - 1; work [qdot_derivative_work]. Never
 * fails. */
void qdot_derivative_eval(const qdot_tape *tape, const double *in, size_t from,
                          size_t columns, double *out, double *J, double *work);

#endif
