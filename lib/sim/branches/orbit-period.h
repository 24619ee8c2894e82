/* orbit-period.h -- whether equations hold the time, and what their period is.
 *
 * Tests  tests/sim/branches/test_orbits.c, tests/bad/continue/continue-orbit.sh
 */
#ifndef QDOT_SIM_ORBIT_PERIOD_H
#define QDOT_SIM_ORBIT_PERIOD_H

#include "sim/model/request.h"

/* Whether the scene's equations, or the changes made by its events, depend explicitly on time. */
QDOT_MUST_CHECK qdot_status qdot_orbit_is_driven(qdot_scene *scene, const qdot_run_request *request,
                                                 bool *driven);

/* The period that the drive has as a function of p (nil: of nothing) and that is T at p = at:
 *
 *     pi k / a,     a t the argument of a sine or cosine that holds p, else any; else T itself
 *
 * QDOT_EINVAL: the equations do not have it at `at`, or at least or most. */
QDOT_MUST_CHECK qdot_status qdot_orbit_period(qdot_scene *scene, const qdot_run_request *request,
                                              qdot_expr p, double at, double T, double least,
                                              double most, qdot_expr *period);

#endif
