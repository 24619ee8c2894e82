/* scales.h -- the sizes near which a scene lives, from its start and its motion.
 *
 * Tolerances and errors are relative to max(s, |value|) (ode/scale.h). s is what the request says;
 * else 1, but of a coordinate whose largest size A along the run is below 1e-3 it is the power of
 * ten at or below A, provided that all coordinates are that small or it does not start at 0, and
 * that A is no rounding: above 1e-12 of the largest coordinate, its error below A/10. Its velocity
 * has the power of ten at or below its own largest size; so have all velocities if none comes to 1e-3: x = cos(t/T) of
 * a long T goes by velocities of 1/T, and 2^-53 of 1 in those, after a time T, would be 2^-53 T in x. If all coordinates are that small, the
 * others (0, or rounding) have the largest scale among those found. A coordinate that grows beyond
 * 1 needs no scale: errors are relative to its value.
 *
 * Tests  tests/script/starts/scale.lag, scale-found.lag
 */
#ifndef QDOT_SIM_SCALES_H
#define QDOT_SIM_SCALES_H

#include "sim/course/run-state.h"

/* The scales [2n] that the run shows, in the order of request->scales, into `scales`; those that
 * the request says stay. *found: whether any differs from that of the run, and the run was cheap
 * enough to be made once more. */
QDOT_MUST_CHECK qdot_status qdot_run_find_scales(qdot_run *run,
                                                 const qdot_run_request *request,
                                                 double *scales, bool *found);

/* Add a notice with the scales [2n]. hold: the run used them; otherwise they were only found. */
QDOT_MUST_CHECK qdot_status qdot_run_say_scales(qdot_run *run, const double *scales,
                                                bool hold);

#endif
