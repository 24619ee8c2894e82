/* parts.h -- coordinates whose equations know nothing of each other, each group of them with
 * a plan of its own.
 *
 * Coordinates belong together where one stands in the other's row of M or f, by itself or
 * by its velocity. Where there are at least two groups each gets steps of its own
 * (ode/apart.h), unless events, bounds or switches look at the steps of the whole: two
 * oscillators of frequency 1 and 1000 cost what each of them does alone.
 *
 * Tests  tests/sim/plan/test_parts.c
 */
#ifndef QDOT_SIM_PARTS_H
#define QDOT_SIM_PARTS_H

#include "sim/model/equations.h"

/* Into plan->parts; none where all hangs together. The plan is made but for this, without
 * constraints and for a method without a Jacobian. */
QDOT_MUST_CHECK qdot_status qdot_parts_find(qdot_plan *plan, qdot_scene *scene,
                                            const qdot_run_request *request);

#endif
