/* course.h -- a run piece by piece: integrated up to what happens, changed, gone on with.
 *
 * Within a piece one plan holds. It ends at the first double of t at which
 *
 *     an event with `then` or `stop` occurs     the state is changed, or the run ends
 *     a coordinate leaves its domain            the run ends, on the last double inside
 *     the equations switch                      the next piece goes by the other side
 *
 * Where a side changes, the arguments of switches around it jump: their sides are decided
 * anew (sim/course/stage.h). Switches that are a rounding of t apart switch at one time.
 *
 * Which side a piece begins on where it starts on a surface is tried (side-search.c): the
 * motion must leave towards the side whose equations it goes by, or stay on the surface where
 * it goes by the equations of u = 0. Where no side does, the motion would slide along the
 * surface, and where more than one does, what comes is not said by the equations: either
 * ends the run.
 *
 * Events without `then` or `stop` are only noted. More than MOST_REPEATS occurrences of
 * one thing within 1e-9 of the run's time end it too: a ball that comes to rest.
 *
 * Tests  tests/script/events.lag, switching.lag, switch-nested.lag, event-ends.sh,
 *        tests/sim/test_switch.c
 */
#ifndef QDOT_SIM_COURSE_H
#define QDOT_SIM_COURSE_H

#include "sim/course/course-state.h"

/* Start from {.stage}; clear it in any case. */
void qdot_course_clear(qdot_course *c);

/* Integrate from y [2n] at t0 to t1 by `method`, under options->tol; options->accepted
 * looks on. What ends a run without an error in the equations is QDOT_OK with `reason`.
 * Else as qdot_trajectory_run, with the run so far kept. */
QDOT_MUST_CHECK qdot_status qdot_course_run(qdot_course *c, const qdot_ode_method *method,
                                            const qdot_ode_options *options, double t0,
                                            double t1, const double *y);

/* The bind of the mode of the start, before or without a run: a start is checked with it,
 * and a c->tr that has been filled otherwise is read with it. */
QDOT_MUST_CHECK qdot_status qdot_course_prepare(qdot_course *c);

/* The systems of all modes that it went by, for cursors along c->tr. */
const qdot_ode_system *qdot_course_systems(const qdot_course *c);

#endif
