/* run-report.h -- what a run tells of itself.
 *
 * Tests  tests/sim/run/test_run.c, tests/script/runs/run.sh
 */
#ifndef QDOT_SIM_RUN_REPORT_H
#define QDOT_SIM_RUN_REPORT_H

#include "sim/course/run-state.h"

/* Fill run->report, all but the error estimate, for a run made with tolerance `tol`. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_fill_report(qdot_run *run, double tol);

#endif
