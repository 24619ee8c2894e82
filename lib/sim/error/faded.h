/* faded.h -- from when on the function of an event stays within its error of 0.
 *
 * A motion that dies out passes below what is known of it: its crossings there are those of rounding. Some are not
 * even sought (sim/course/piece-fade.c). Others show themselves by the run's companions: between the last occurrences
 * the function is nowhere larger than its error.
 *
 * Tests  tests/script/events/decayed-events.sh
 */
#ifndef QDOT_SIM_FADED_H
#define QDOT_SIM_FADED_H

#include "sim/course/run-state.h"

/* Of event `event`: since when it stays within its error until the end of the run, NaN: it does not. Occurrences from
 * then on are none that is known. */
QDOT_MUST_CHECK qdot_status qdot_faded_find(qdot_run *run, size_t event, double *from);

#endif
