/* tighter-run.h -- the tolerance of `auto` where the one asked for leaves no digit at the end.
 *
 * A run under tol has lost its digits at its horizon h (sim/error/horizon.h): neighbouring motions part by a
 * factor of about 1/tol until then. If they part exponentially, which is the fastest that lasts, one
 * under another tolerance is lost at h log(tol')/log(tol). If that is beyond the end, for the least tol'
 * of a double, the run is made once more under it, and stays so if it has no horizon then. The same if
 * they part as a power of t, so that the distance at the end is tol'/tol (t1/h)^k. And so is a run
 * whose error is unknown, as where its companions are too costly or meet other events: it stays if that is
 * known then.
 *
 * Tests  tests/script/studies/tighter.sh
 */
#ifndef QDOT_SIM_TIGHTER_RUN_H
#define QDOT_SIM_TIGHTER_RUN_H

#include "sim/run/change-over.h"

/* Replace *run by a run with tighter tolerance, with a notice. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_run_tighten(qdot_scene *scene, const qdot_run_request *request,
                                             const qdot_run_maker *by, qdot_run **run);

#endif
