/* touches.h -- whether extrema that come near an event touch it, by what the run's errors are.
 *
 * While a run is integrated its errors are unknown, so that an extremum v of an event's function
 * within the tolerance counts as a touch. Most runs are far more exact. With the error e of the
 * function there, from the companions:
 *
 *     |v| > 2 e     no touch: two crossings, or none; to be searched for under less tolerance
 *     else          a touch, as far as can be told: it may stand for two crossings at
 *                   +- sqrt(2 (|v| + e)/|g''|) beside it
 *
 * Tests  tests/script/contacts/grazing.lag
 */
#ifndef QDOT_SIM_TOUCHES_H
#define QDOT_SIM_TOUCHES_H

#include "sim/course/run-state.h"

/* Look at the touches of event `event` beyond rounding.
 *   widths  NULL, or [occurrences of the run] where that of such a touch is set: how far from it two
 *           crossings may lie that it stands for; NaN: unknown
 *   tol     NULL, or the run's tolerance for touches: if a touch is none it is lowered so that the
 *           same run, made anew, tells crossings from misses */
QDOT_MUST_CHECK qdot_status qdot_touches_look(qdot_run *run, size_t event, double *widths,
                                              double *tol);

/* Whether the function of event `event` is 0 at the end of the run but for its error, without a root found
 * there: what has a root just before the end has it behind it by other rounding. */
QDOT_MUST_CHECK qdot_status qdot_touches_end(qdot_run *run, size_t event, bool *undecided);

/* Where the event crosses 0: the error of its function at the time, as that of any value, divided by its slope, into errors [occurrences];
 * others stay, and those of what meets because another event of the same instant has moved it. Companions may be off by little
 * at one time by chance: that of the function is looked at around it. */
QDOT_MUST_CHECK qdot_status qdot_touches_crossings(qdot_run *run, size_t event, double *errors);

#endif
