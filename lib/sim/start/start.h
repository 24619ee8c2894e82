/* start.h -- initial states that keep the constraints.
 *
 * Positions first, f(q, t0) = 0 of the holonomic constraints; then velocities, df/dt = 0
 * of these and f(q, q', t0) = 0 of the velocity constraints, at these positions. Where a
 * start breaks one:
 *
 *     1. named values are kept, the others are solved for, nearest to 0;
 *     2. if that has no solution, all values move, as little as possible in the metric of M; a
 *     notice
 *        says how far;
 *     3. two solutions equally near are an error that asks for one more value.
 *
 * Then the equations of coordinates without mass (sim/model/massless.h) likewise, where these alone
 * move.
 *
 * What is 0 at the start is decided by its exact values (sim/start/given.h).
 *
 * A start breaks a constraint if it is further from it than 1e-14 max(1, |x|). Nearer ones are
 * refined too, so that F is 0 to the precision of two doubles for each value.
 *
 * Source  least change in a metric: Hairer, Lubich & Wanner, Geometric Numerical
 *         Integration, sec. IV.4; the search: sim/start/nearest.h.
 * Tests   tests/sim/start/test_start.c, tests/script/starts/start-*.lag
 */
#ifndef QDOT_SIM_START_H
#define QDOT_SIM_START_H

#include "base/text.h"
#include "sim/model/domain.h"

/* Move y [2n] + low [2n] so that it keeps the constraints of the scene.
 *   request  t0; q_named, v_named (NULL: all are named); exactly
 *   domains  of the coordinates: values that are solved for stay inside
 *   notice   gets how far named values were moved; else unchanged
 * Errors: QDOT_EINVAL: `exactly`, two answers, contradictory constraints (named);
 * QDOT_EUNSET ... */
QDOT_MUST_CHECK qdot_status qdot_start_settle(qdot_scene *scene, const qdot_plan *plan,
                                              const qdot_run_request *request,
                                              const qdot_domains *domains, double *y,
                                              double *low, qdot_text *notice);

/* Append to `notice` the names of redundant constraints: their gradients at the settled y + low [2n]
 * depend on those of the constraints before them. Appends nothing if all are independent. */
QDOT_MUST_CHECK qdot_status qdot_start_redundant(qdot_scene *scene, const qdot_plan *plan,
                                                 const qdot_run_request *request,
                                                 const double *y, const double *low,
                                                 qdot_text *notice);

#endif
