/* collide.h -- a run once more through a collision (mech/coordinates/collision.h).
 *
 * A run that failed or did badly, and came near a place where two points attract each other by k/r^2,
 * is made anew in regular coordinates, by s with dt = R ds, from s = 0 to where t is the end that was
 * asked for: an event. Polar and spherical coordinates are left first (mech/coordinates/chart.h). Then the
 * trajectories are timed by t (ode/trajectory.h), so that all that reads them knows nothing of s.
 *
 * Tests  tests/script/mechanisms/collisions.lag
 */
#ifndef QDOT_SIM_COLLIDE_H
#define QDOT_SIM_COLLIDE_H

#include "sim/run/change-over.h"

/* The run through the collision that `run` came nearest to into *out; NULL: there is none, or no run.
 * Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_run_collide(qdot_scene *scene,
                                             const qdot_run_request *request,
                                             const qdot_run_maker *by, qdot_run *run,
                                             qdot_run **out);

#endif
