/* chatter.h -- what a motion that goes to and fro across a surface, too fast to be followed, makes of numbers.
 *
 * On a surface u(q, t) = 0 to which both sides lead back, u'' = -a+ above and a- below, the motion that meets it
 * with |u'| = v goes to and fro by |u| <= v^2/(2 a). Where that is less than the rounding of u no double can
 * follow it: the motion slides, and u and u' are uncertain by what it does about the surface.
 *
 * Its speed changes slowly by what the accelerations hold of u' and of the time,
 *
 *     u'' = -+a - b u',   d(log v)/dt = mean of (a'/a - b)/3 by the times 2 v/a on both sides
 *
 * Where it grows tenfold until the end of the run the motion does not slide.
 *
 * Tests  tests/script/contacts/relay-at-rounding.lag, tests/sim/model/test_sliding.c
 */
#ifndef QDOT_SIM_CHATTER_H
#define QDOT_SIM_CHATTER_H

#include "sim/course/course.h"
#include "sim/course/reader.h"

/* Whether at time t the motion oscillates too fast about a surface to be followed. */
bool qdot_chatters_at(const qdot_course *course, double t);

/* Add to errors [n] the error that a fast oscillation about a surface causes in the state y [n] at t. */
void qdot_chatter_add_state(const qdot_course *course, double t, const double *y, double *errors);

/* Add what it makes of the expressions [m] of the reader, along that course alone, to errors [m]; values [m] were
 * read last, at t. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_chatter_add(const qdot_course *course, qdot_reader *r, double t,
                                             const double *values, double *errors);

#endif
