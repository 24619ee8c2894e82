/* run-time.h -- the times of a run far from t = 0.
 *
 *     t = origin + s
 *
 * Doubles near t = 1e9 are 1e-7 apart. A run far from 0 beside its length counts its times s from an
 * origin, the double at its start; its courses, their errors and all that sim does with them are in s. What
 * asks the run and what it tells (sim/run/run.h, sim/read/section.h) is in t: these functions turn one into
 * the other. Where the origin is 0 they do nothing.
 *
 * Tests  tests/sim/run/test_far.c, tests/script/events/far.lag
 */
#ifndef QDOT_SIM_RUN_TIME_H
#define QDOT_SIM_RUN_TIME_H

#include "sim/course/run-state.h"

/* The user's time t that corresponds to a time s counted from the run's origin. */
double qdot_run_time_told(const qdot_run *run, double s);

/* From here on the run, which is finished, tells its times from that origin: its texts are written anew. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_time_begin(qdot_run *run, double origin);

/* The report with the user's times t; also the times t of the stored points, [*n]. Both borrowed. */
const qdot_run_report *qdot_run_time_report(const qdot_run *run);
const double *qdot_run_time_points(const qdot_run *run, size_t *n);

/* s at t + low, and what it leaves out, *rest. At the time of an event, rounded, that of the event itself; beside
 * the ends of the run, by a rounding of t, those. */
void qdot_run_time_own(const qdot_run *run, double t, double low, double *s, double *rest);

/* Expressions given [m] with t in terms of s: *own is `given`, or owned by the caller: *made. Errors: of the
 * pool. */
QDOT_MUST_CHECK qdot_status qdot_run_time_express(const qdot_run *run, size_t m, const qdot_expr *given,
                                                  const qdot_expr **own, qdot_expr **made);

/* Copy a text with its times converted to t: numbers after "t = ", and the upper ends of ranges
 * that begin so. */
void qdot_run_time_tell(double origin, const char *text, qdot_text *out);

/* If `status` is a failure, convert the times in the error message to the user's t; returns `status`. */
qdot_status qdot_run_time_fail(double origin, qdot_status status);

#endif
