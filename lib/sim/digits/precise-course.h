/* precise-course.h -- a run in MPFR through the events and switches that a run in doubles met.
 *
 * The run in doubles (its guide, sim/course/course.h) says which modes follow each other, what
 * ends each piece, and where to the digits of a double. In MPFR a piece is integrated by
 * its mode past that place, the time at which the same function vanishes is located there
 *
 *     g(y(t)) = 0    between t_guide -+ pad, pad = 2^-8 of the piece
 *
 * by false position (Illinois) to the last bits, the run cut there, and what `then` says
 * evaluated in all digits. So a scene whose events a double cannot tell apart is told to
 * have no `digits`: QDOT_ELIMIT.
 *
 * Source  Dowell & Jarratt, BIT 11 (1971) 168
 * Tests   tests/script/digits-events.sh
 */
#ifndef QDOT_SIM_PRECISE_COURSE_H
#define QDOT_SIM_PRECISE_COURSE_H

#include "sim/digits/precise-pair.h"

/* Binds and programs of what the guide met: all that needs the pool. */
QDOT_MUST_CHECK qdot_status qdot_precise_course_init(qdot_precise_side *s);
void qdot_precise_course_clear(qdot_precise_side *s);

/* All pieces from s->start into s->segments, the times of the guide's occurrences into
 * s->times (NaN: one that only touches). s->status says how it went. */
void qdot_precise_course_run(qdot_precise_side *s);

#endif
