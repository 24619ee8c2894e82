/* shake.h -- the same tape with its constants rounded the other way.
 *
 * A constant that is no double was rounded to its neighbour below or above; in the shaken
 * tape it is the other one, so that the exact value lies between the two. What differs
 * between runs on both shows what the rounding of constants may do.
 *
 * Tests  tests/tape/test_tape.c
 */
#ifndef QDOT_TAPE_SHAKE_H
#define QDOT_TAPE_SHAKE_H

#include "tape/tape.h"

/* A copy, owned by the caller. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tape_shake(const qdot_tape *tape, qdot_tape **shaken);

/* The neighbour of x on that side; x itself for 0. */
double qdot_shake_double(double x, int side);

#endif
