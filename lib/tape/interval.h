/* interval.h -- a tape over intervals of the real line.
 *
 *     lo_j <= x_j <= hi_j for every input   =>   L_i <= f_i(x) <= H_i for every output
 *
 * where f_i(x) is defined. Beside discs (tape/disc.h) it says less of smooth functions - nothing
 * about derivatives - and more where a formula is too large for a double, or switches, or where
 * one of its parts is of one sign: 1/cosh(x)^2 at x > 1000 is in 0 ... 10^-308, abs(x) and if(...)
 * are what either side is. A bound is infinite where there is none, never NaN.
 *
 * Each operation has a row in interval.def. Bounds are moved outward by the rounding of the
 * operation, except for those of intervals that are all numbers: these are what the
 * tape is in doubles.
 *
 * Source  Moore, Kearfott & Cloud, Introduction to Interval Analysis (2009), chapters 2 and 5.
 * Tests   tests/tape/test_interval.c
 */
#ifndef QDOT_TAPE_INTERVAL_H
#define QDOT_TAPE_INTERVAL_H

#include "tape/tape.h"

typedef struct {
    double lo, hi;
} qdot_interval;

/* Intervals of work space wanted. */
size_t qdot_interval_work(const qdot_tape *tape);

/* out [outputs] of in [inputs]; work [qdot_interval_work]. Never fails. */
void qdot_interval_eval(const qdot_tape *tape, const qdot_interval *in, qdot_interval *out,
                        qdot_interval *work);

#endif
