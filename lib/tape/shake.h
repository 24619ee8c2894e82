/* shake.h -- a copy of a tape with its constants rounded the other way.
 *
 * A constant that is not a double was rounded to its neighbour below or above; the shaken tape
 * has the other neighbour, so that the exact value lies between the two. The difference of runs
 * with both tapes shows the effect of rounding the constants.
 *
 * Tests  tests/tape/test_tape.c
 */
#ifndef QDOT_TAPE_SHAKE_H
#define QDOT_TAPE_SHAKE_H

#include "tape/tape.h"

/* Copy a tape, rounded constants replaced by the doubles on the other side; owned by the caller. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tape_shake(const qdot_tape *tape, qdot_tape **shaken);

/* The double that lies |side| ulps from x, above x if side > 0, below if side < 0. */
double qdot_shake_double(double x, int side);

#endif
