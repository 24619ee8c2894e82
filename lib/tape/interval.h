/* interval.h -- bounds of a tape over intervals of the real line.
 *
 *     lo_j <= x_j <= hi_j for every input   =>   L_i <= f_i(x) <= H_i for every output
 *
 * wherever f_i(x) is defined. Compared with discs (tape/disc.h) the bounds are weaker for smooth
 * functions, without derivatives, but better if a part overflows, switches, or has one sign:
 * 1/cosh(x)^2 at x > 1000 is in 0 ... 10^-308, abs(x) and if(...) are in the hull of both sides.
 * A bound is infinite if there is none, never NaN.
 *
 * Each operation has a column of its row in operation.def. Bounds are moved outward by the rounding of the
 * operation, except if all operands are single numbers: then the result is that of the tape in
 * doubles.
 *
 * Source  Moore, Kearfott & Cloud, Introduction to Interval Analysis (2009), chapters 2 and 5.
 * Tests   tests/tape/test_interval.c
 */
#ifndef QDOT_TAPE_INTERVAL_H
#define QDOT_TAPE_INTERVAL_H

#include "num/interval.h"
#include "tape/tape.h"

/* The number of intervals that the evaluation of a tape over intervals needs as work space. */
size_t qdot_interval_work(const qdot_tape *tape);

/* Evaluate outputs out [outputs] for intervals in [inputs]; work [qdot_interval_work]. Never fails. */
void qdot_interval_eval(const qdot_tape *tape, const qdot_interval *in, qdot_interval *out,
                        qdot_interval *work);

#endif
