/* orbit-run.h -- the run that is a periodic orbit: it ends where it began.
 *
 * Tests  tests/script/studies/floquet.sh, continue-orbit.lag
 */
#ifndef QDOT_LANG_ORBIT_RUN_H
#define QDOT_LANG_ORBIT_RUN_H

#include "lang/session/parts.h"
#include "lang/session/runs.h"

/* Find the latest run of the scene that is a periodic orbit. QDOT_EINVAL: there is none. */
QDOT_MUST_CHECK qdot_status qdot_orbit_run_find(qdot_session *session, qdot_named_run **orbit);
/* Find the run of that name, which must be a periodic orbit. */
QDOT_MUST_CHECK qdot_status qdot_orbit_run_named(qdot_session *session, const char *name,
                                                 qdot_named_run **orbit);

#endif
