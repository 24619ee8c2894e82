/* precise.h -- a tape in numbers of any precision (MPFR): its values, and its Taylor
 * coefficients.
 *
 * The constants are evaluated from their expressions to the precision asked for. A row of
 * coefficients belongs to each value; order 0 is the value itself, so a program for
 * order 0 evaluates the tape and has every operation. Above it the recurrences are those
 * of taylor.h; operations that switch have none.
 *
 * Source  as taylor.h
 * Tests   tests/series/test_precise.c
 */
#ifndef QDOT_SERIES_PRECISE_H
#define QDOT_SERIES_PRECISE_H

#include <mpfr.h>

#include "series/motion.h"

typedef struct qdot_precise qdot_precise; /* coefficients in many digits; must not be shared between threads */

/* For orders 0 ... most, with numbers of `bits` (rounded up to whole limbs). The pool is
 * used here and not kept; the tape is not kept. Errors: QDOT_ENOTBUILT (most > 0 and an
 * operation that switches), those of a constant, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_precise_new(qdot_pool *pool, const qdot_tape *tape,
                                             int most, mpfr_prec_t bits,
                                             qdot_precise **precise);
void qdot_precise_free(qdot_precise *p);

/* Coefficients by order of input i, written by the caller before each order; the rows of
 * the inputs follow each other at a distance of qdot_precise_stride. */
mpfr_t *qdot_precise_input(qdot_precise *p, size_t i);
size_t qdot_precise_stride(const qdot_precise *p);

/* The Taylor coefficients of output i, by order. */
const mpfr_t *qdot_precise_output(const qdot_precise *p, size_t i);
/* log2 of a step, INFINITY for any, or of as much of it as carries no argument of an exponential
 * too far (near.h), orders up to k being there. */
double qdot_precise_near(const qdot_precise *p, int k, double log2_h);

/* Order k of all that is computed, orders below k being there: 0 first. Never fails; NaN
 * and inf as MPFR has them. Nothing is allocated but by functions of MPFR at order 0. */
void qdot_precise_order(qdot_precise *p, int k);

/* --- motions with unknown accelerations ---------------------------------------------- */

/* Of a motion, borrowed: rows to order `most` and ahead of it as far as they lead; the unit of time
 * is 1. Errors: those of a constant, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_precise_of_motion(qdot_pool *pool,
                                                   const qdot_motion *motion, int most,
                                                   mpfr_prec_t bits,
                                                   qdot_precise **precise);
const mpfr_t *qdot_precise_row(const qdot_precise *p, qdot_program_row row);

/* Stage k of the expansion, from qdot_motion_first on, what is solved for being 0. Then that
 * changes by `by` [solved], and with it what later orders read: E stays what it was. */
void qdot_precise_stage(qdot_precise *p, int k);
void qdot_precise_change(qdot_precise *p, int k, const mpfr_t *by);
/* Behind stage 0 of a motion without entries: column j of the block of K [n x n] whose first unknown
 * is `first`, an entry every n. */
void qdot_precise_column(qdot_precise *p, size_t first, size_t n, size_t j, mpfr_t *column);

#endif
