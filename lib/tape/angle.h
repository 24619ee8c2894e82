/* angle.h -- decides which angles get a call of sine and cosine, and which are composed of
 * others.
 *
 *     sin(A + B) = sA cB + cA sB,   cos(A + B) = cA cB - sA sB,   sin 2A = 2 sA cA ...
 *
 * Every argument of a trigonometric function is a sum of rational multiples of terms and
 * a constant: sum k_i (g_i t_i) + c, where g_i t_i is the base angle of the term t_i (g_i:
 * the greatest common divisor of its multiples, as long as no k_i is large). Arguments
 * share common initial sums. An argument is either composed of base angles or gets its own call,
 * whichever makes the whole cheaper: a call counts as 20 operations, an addition of angles as 6.
 * For a chain of N links that is N calls and N^2/2 additions. In a tape for series a call is two
 * products of series and an addition four: then differences of angles get their own calls.
 *
 * Tests  tests/tape/test_tape.c: the chain's counts, and values against libm.
 */
#ifndef QDOT_TAPE_ANGLE_H
#define QDOT_TAPE_ANGLE_H

#include "expr/walk.h"
#include "tape/code.h"

typedef struct qdot_angles qdot_angles;

/* Decide for all arguments of sin ... cot in the walk. `series`: for a tape for series.
 * Constructs numbers in the pool. */
QDOT_MUST_CHECK qdot_status qdot_angles_new(qdot_pool *pool, const qdot_walk *walk,
                                            bool series, qdot_angles **angles);
void qdot_angles_free(qdot_angles *angles);

/* Write sine and cosine of the argument e into the code. The walk's value of e and of each term
 * in it is its qdot_value. */
void qdot_angles_pair(qdot_angles *angles, const qdot_walk *walk, qdot_code *code,
                      qdot_expr e, qdot_value *sine, qdot_value *cosine);

#endif
