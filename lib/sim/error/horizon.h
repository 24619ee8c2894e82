/* horizon.h -- the time beyond which no digit of a run is correct.
 *
 * In a chaotic scene the distance of two neighbouring motions grows exponentially until
 * it is as large as the motion itself; from then on the run is one motion of many, and its end
 * state is arbitrary. With y the run, y* its companion
 * (ode/companion.h) and V the largest variation of a component,
 *
 *     d(t) = max_i |y_i - y*_i| / max(s_i, min(|y_i|, |y*_i|)), as either may be the right one
 *     V    = max_i (max y_i - min y_i) / 2 / max(s_i, max |y_i|)  over both runs, s_i the scales
 *
 * the horizon is the first time with d >= V/10 from which on d >= V/10 holds for half of
 * the time that is left: a distance that is large for a moment, at a pericentre, comes
 * back. Between the stored points log d is taken as linear. A run of which less than a
 * hundredth lies beyond has none, nor has a motion that moves by less than 100 tolerances.
 *
 * Beyond it the error stated, of the end or of an expression, is at least the mean distance
 * of the two runs beyond it: at one time they may be near each other by chance.
 * Energy and whatever else is not chaotic keeps a small one.
 *
 * Tests  tests/sim/error/test_horizon.c: against runs with `digits`
 */
#ifndef QDOT_SIM_HORIZON_H
#define QDOT_SIM_HORIZON_H

#include "sim/course/reader.h"
#include "sim/course/report.h"

/* For a run whose error is known: set report.horizon, and report.error if there is a horizon.
 * QDOT_OK without one too. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_horizon_find(qdot_run *run);

/* The variation V of a trajectory; at a distance of QDOT_HORIZON_NONE_LEFT V no digit is correct. */
double qdot_horizon_variation(const qdot_trajectory *tr);
#define QDOT_HORIZON_NONE_LEFT 0.1

/* Whether t lies beyond the horizon of the run. */
bool qdot_horizon_passed(const qdot_run *run, double t);

/* The mean distance of expressions [m] in the two runs beyond the horizon, into spread [m]; 0
 * without a horizon. Of expressions along several courses, run->course is own[which]. */
QDOT_MUST_CHECK qdot_status qdot_horizon_spread(const qdot_run *run, const qdot_reading *of,
                                                const qdot_course *const *own, size_t which,
                                                double *spread);

#endif
