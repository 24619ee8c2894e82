/* extremum.h -- where an expression along a run is largest or least.
 *
 * The range is halved towards the value, then de/dt = 0 is found by Newton's method; at an end of the range
 * the extremum is that end.
 *
 * Tests  tests/script/studies/sensitivity.sh
 */
#ifndef QDOT_SIM_EXTREMUM_H
#define QDOT_SIM_EXTREMUM_H

#include "sim/run/run.h"

/* The extremum of an expression e to be found, with e, de/dt and d2e/dt2 along the run. */
typedef struct {
    qdot_run *run;
    qdot_range_kind kind; /* what is sought: QDOT_RANGE_MAX or QDOT_RANGE_MIN */
    qdot_expr e, rate, bend;
    double from, to;
} qdot_extremum;

/* Find the time *t of the extremum. QDOT_EFAILED: e has a corner or a jump there. */
QDOT_MUST_CHECK qdot_status qdot_extremum_time(const qdot_extremum *x, double *t);

#endif
