/* sweep-lanes.h -- the members of a sweep side by side (sim/ensemble/ensemble.h), where they can be.
 *
 * They can if the scene fits (sim/ensemble/fit.h), what is swept is coordinates, velocities and
 * parameters that nothing but the equations and the start reads, and each column is an expression at
 * the end of the run, NAME[K], the time of an event, or contains value, max, min, mean or drift and no
 * event: these are read as of a run alone (sim/ensemble/path.h). A member that turns out to need more than lanes
 * do - it fails, comes near a bound, touches an event, lives far below 1, loses its digits - is run
 * alone. So which way a row is made depends on the statement and the member only, and its bits on no
 * other member.
 *
 * The error of a column is found as that of a run alone: by the distance from companions at the end, and
 * at places of the latter half of the way, of which the median counts, to 30 times that at the end
 * (ode/companion.h), with the rounding of its terms. One companion is enough where the method's errors
 * are well above those of rounding, and no column reads the way; the others have two.
 *
 * Tests  tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_LANG_SWEEP_LANES_H
#define QDOT_LANG_SWEEP_LANES_H

#include "base/text.h"
#include "lang/sweeps/sweep-parts.h"

/* The runs of a sweep with fewer runs than this are made one by one, not together in vector lanes. */
enum { QDOT_SWEEP_LANES_LEAST = 16 };

typedef struct qdot_sweep_lanes qdot_sweep_lanes;

/* Bytes for each run (member) of a sweep: whether it is finished, and why its row failed. */
enum { QDOT_SWEEP_LANES_BYTES = sizeof(bool) + sizeof(char *) };

/* Prepare to make the runs of a sweep together in vector lanes. *lanes NULL: one by one, and `why` says why. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_new(qdot_sweep *s, qdot_sweep_lanes **lanes,
                                                 qdot_text *why);
void qdot_sweep_lanes_free(qdot_sweep_lanes *lanes);

/* Make these runs [n] of the sweep; _run: those of first ... first + count - 1 that are not finished. */
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_run_rows(qdot_sweep_lanes *lanes, const size_t *rows,
                                                      size_t n);
QDOT_MUST_CHECK qdot_status qdot_sweep_lanes_run(qdot_sweep_lanes *lanes, size_t first,
                                                 size_t count);
/* Whether row k has been made; if so, *status is its status, and its error becomes the last error. */
bool qdot_sweep_lanes_made(qdot_sweep_lanes *lanes, size_t k, qdot_status *status);

#endif
