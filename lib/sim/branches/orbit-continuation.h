/* orbit-continuation.h -- the curve of periodic orbits through a given one, the curves that cross it, and the
 * bifurcations on them (continuation.h).
 *
 * Tests  tests/sim/branches/test_orbits.c, tests/script/continue/continue-orbit.lag
 */
#ifndef QDOT_SIM_ORBIT_CONTINUATION_H
#define QDOT_SIM_ORBIT_CONTINUATION_H

#include "sim/branches/continuation.h"
#include "sim/branches/orbit-path.h"

/* Follow them. From {0}; cleared in any case. Where it is interrupted, what is known stays, and the status is QDOT_OK.
 * Errors: those of qdot_orbit_path_begin; QDOT_EFAILED: no orbit near the first can be followed; QDOT_EINVAL: p is outside
 * its range there. */
QDOT_MUST_CHECK qdot_status qdot_orbit_continuation_find(const qdot_orbit_of *of,
                                                         qdot_continuation *out);

#endif
