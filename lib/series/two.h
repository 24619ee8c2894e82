/* two.h -- a tape over power series whose coefficients are sums of two doubles: the first
 * orders of a series to about 31 digits.
 *
 * The recurrences are those of taylor.h, constants are what they are to two doubles.
 *
 * Source  as taylor.h and num/two.h
 * Tests   tests/series/test_two.c
 */
#ifndef QDOT_SERIES_TWO_H
#define QDOT_SERIES_TWO_H

#include "num/two.h"
#include "series/motion.h"

typedef struct qdot_tape_two qdot_tape_two; /* must not be shared between threads */

/* For orders 0 ... most. The inputs from `moving` on are numbers, without coefficients
 * beyond order 0. The tape is not kept. Order 0 is there for every operation, above it
 * operations that switch have none: QDOT_ENOTBUILT (most > 0). QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tape_two_new(const qdot_tape *tape, int most,
                                              size_t moving, qdot_tape_two **two);
void qdot_tape_two_free(qdot_tape_two *t);

/* Coefficients by order of input i, written by the caller before each order; the rows of
 * the inputs follow each other at a distance of qdot_tape_two_stride. */
qdot_two *qdot_tape_two_input(qdot_tape_two *t, size_t i);
size_t qdot_tape_two_stride(const qdot_tape_two *t);

/* The Taylor coefficients of output i, by order. */
const qdot_two *qdot_tape_two_output(const qdot_tape_two *t, size_t i);

/* The relative rounding error of an operation; larger if the program has functions such as sine (num/two.h). */
double qdot_tape_two_rounding(const qdot_tape_two *t);

/* On which sides what switches was at order 0 last: abs and sign by their argument, min, max and comparisons by the
 * difference, floor and mod by the integer. A number that is another one on other sides; 0: on the border of two. */
uint64_t qdot_tape_two_sides(const qdot_tape_two *t);

/* Order k of all that is computed, orders below k being there: 0 first. Never fails; NaN
 * and inf as IEEE 754 has them, where one of two doubles is. */
void qdot_tape_two_order(qdot_tape_two *t, int k);

/* --- motions: systems with accelerations as unknowns --------------------------------- */

/* The highest order of accelerations that is computed in two doubles. */
enum { QDOT_TWO_MOST = 12 };

/* Of a motion, borrowed: orders 0 ... QDOT_TWO_MOST + 1 of its rows. The unit of time, a power of
 * two, is 1 until it is set. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tape_two_of_motion(const qdot_motion *motion,
                                                    qdot_tape_two **two);
void qdot_tape_two_set_unit(qdot_tape_two *t, double unit);
const qdot_two *qdot_tape_two_row(const qdot_tape_two *t, qdot_program_row row);

/* Stage k of the expansion, from qdot_motion_first on; the unknowns that are solved for begin as
 * guess [solved], from stage 0 on. Then these change by `by` [solved], numbers so small that a
 * double of them is enough, and all that is `newest` with them, E too. */
void qdot_tape_two_stage(qdot_tape_two *t, int k, const double *guess);
void qdot_tape_two_change(qdot_tape_two *t, int k, const double *by);

#endif
