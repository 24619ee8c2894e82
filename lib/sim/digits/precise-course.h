/* precise-course.h -- a run in MPFR through the events and switches that a run in doubles met.
 *
 * The run in doubles (the guide, sim/course/course.h) gives the sequence of modes, what ends each
 * piece, and the time of that to the digits of a double. In MPFR a piece is integrated in its
 * mode past that time, the time at which the same function vanishes is located there
 *
 *     g(y(t)) = 0    between t_guide -+ pad, pad = 2^-8 of the piece
 *
 * by false position (Illinois) to the last bits, the run is cut there, and `then` is evaluated in
 * all digits. If doubles cannot tell the events of a scene apart, `digits` is refused:
 * QDOT_ELIMIT.
 *
 * Where the guide comes to rest at a contact, the bounces that are too low for it follow in MPFR: flights in the mode
 * of the last one, each as much shorter as the impact before it was hard, until the height u' T of the next is hidden
 * by the rounding of the place. What is left of u' is then taken off along the last impulse.
 *
 * Source  Dowell & Jarratt, BIT 11 (1971) 168
 * Tests   tests/script/digits/digits-events.lag, digits-resting.lag
 */
#ifndef QDOT_SIM_PRECISE_COURSE_H
#define QDOT_SIM_PRECISE_COURSE_H

#include "sim/digits/precise-pair.h"

/* Make the binds and programs for the modes and events of the guide: everything that needs the
 * pool. */
QDOT_MUST_CHECK qdot_status qdot_precise_course_init(qdot_precise_side *s);
void qdot_precise_course_clear(qdot_precise_side *s);

/* Integrate all pieces from s->start into s->segments; the times of the guide's occurrences go to
 * s->times (NaN: g only touches 0). Sets s->status. */
void qdot_precise_course_run(qdot_precise_side *s);

/* Fail with QDOT_ELIMIT: double precision does not decide what happens at time t. */
QDOT_MUST_CHECK qdot_status qdot_precise_beyond_doubles(double t);

#endif
