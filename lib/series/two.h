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
#include "tape/tape.h"

typedef struct qdot_tape_two qdot_tape_two; /* one a thread */

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

/* Coefficients by order of output i; whether it has those of order 0 only. */
const qdot_two *qdot_tape_two_output(const qdot_tape_two *t, size_t i);
bool qdot_tape_two_is_constant(const qdot_tape_two *t, size_t i);

/* Order k of all that is computed, orders below k being there: 0 first. Never fails; NaN
 * and inf as IEEE 754 has them, where one of two doubles is. */
void qdot_tape_two_order(qdot_tape_two *t, int k);

/* Order k > 0 was evaluated, and is affine in the newest coefficients of the inputs: those of
 * the first n change by `by`, numbers so small that a double of them is enough. All of order k
 * is brought up to date, inputs too, by derivatives at order 0. */
void qdot_tape_two_correct(qdot_tape_two *t, int k, size_t n, const double *by);

#endif
