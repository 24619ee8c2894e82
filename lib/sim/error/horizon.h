/* horizon.h -- the time beyond which a run has no digit left.
 *
 * In a chaotic scene the distance of two neighbouring motions grows exponentially until
 * it is as large as the motion itself; from there on the states of a run are one motion
 * of many, and what it says of the end is noise. With y the run, y* its companion
 * (ode/companion.h) and V the largest variation of a component,
 *
 *     d(t) = max_i |y_i - y*_i| / max(1, |y_i|)
 *     V    = max_i (max y_i - min y_i) / 2 / max(1, max |y_i|)    over both runs
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
 * Tests  tests/sim/test_horizon.c: against runs with `digits`
 */
#ifndef QDOT_SIM_HORIZON_H
#define QDOT_SIM_HORIZON_H

#include "sim/course/reader.h"
#include "sim/course/report.h"

/* Of a run that has its error: report.horizon, and report.error where there is one.
 * QDOT_OK without a horizon too. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_horizon_find(qdot_run *run);

/* V of one trajectory; and what of it leaves no digit, 1/10. */
double qdot_horizon_variation(const qdot_trajectory *tr);
#define QDOT_HORIZON_NONE_LEFT 0.1

/* Whether t lies beyond it. */
bool qdot_horizon_passed(const qdot_run *run, double t);

/* Of expressions [m] the mean distance of the two runs beyond the horizon into spread [m];
 * 0 where there is no horizon. */
QDOT_MUST_CHECK qdot_status qdot_horizon_spread(const qdot_run *run, const qdot_reading *of,
                                                double *spread);

#endif
