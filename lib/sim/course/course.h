/* course.h -- integrates a run piece by piece, through events and switches.
 *
 * Within a piece the equations are those of one plan. A piece ends at the first double of t at
 * which
 *
 *     an event with `then` or `stop` occurs     the state is changed, or the run ends
 *     a coordinate leaves its domain            the run ends, on the last double inside
 *     the equations switch                      the next piece has those of the other side
 *
 * If a side changes, the arguments of switches around it jump, and their sides are decided anew
 * (sim/course/stage.h). Switches within rounding of one time count as simultaneous.
 *
 * If a piece starts on a surface, side-search.c tries the sides: the motion must leave towards
 * the side whose equations it follows, or stay on the surface with the equations of u = 0. If it
 * does so for no side, it slides along the surface (sim/model/sliding.h); if that cannot be, or if it
 * does so for more than one, the run ends.
 *
 * Events without `then` or `stop` are only recorded. A run also ends if one event or switch
 * occurs more than MOST_REPEATS times within 1e-9 of its time: a ball that comes to rest.
 *
 * Tests  tests/script/events/events.lag, switching.lag, switch-nested.lag, event-ends.sh,
 *        tests/sim/model/test_switch.c
 */
#ifndef QDOT_SIM_COURSE_H
#define QDOT_SIM_COURSE_H

#include "sim/course/course-state.h"

/* Free the contents. A course starts as {.stage} and must be cleared in any case. */
void qdot_course_clear(qdot_course *c);

/* The text after the time in a reason "stopped at t = TIME: CAUSE"; NULL for reasons of another form. */
const char *qdot_course_cause(const char *reason);

/* Integrate from y [2n] at t0 to t1 by `method`, under options->tol; options->accepted
 * is called as there. If an event, bound or switch ends the run, QDOT_OK with `reason`. Other
 * errors as qdot_trajectory_run, with the run so far kept. */
QDOT_MUST_CHECK qdot_status qdot_course_run(qdot_course *c, const qdot_ode_method *method,
                                            const qdot_ode_options *options, double t0,
                                            double t1, const double *y);

/* Make c->history, of q and q', if the plan has delays and there is none yet. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_course_remember(qdot_course *c, const qdot_plan *plan);
/* The same; and the history begins at t0 with y [2n], q and q', an earlier run of this course being forgotten: before t0 nothing
 * moved, q had these values. */
QDOT_MUST_CHECK qdot_status qdot_course_begin_history(qdot_course *c, double t0, const double *y);

/* Make the bind of the first mode, before or without a run: to check a start, or to read a c->tr
 * that something else has filled. */
QDOT_MUST_CHECK qdot_status qdot_course_prepare(qdot_course *c);

/* The number of occurrences of an event in the course. */
size_t qdot_course_count(const qdot_course *c, size_t event);

/* The systems of equations of all modes of the run, for cursors along c->tr. */
const qdot_ode_system *qdot_course_systems(const qdot_course *c);

#endif
