/* geometric.h -- which equations the methods for long times are for (ode/geometric/geometric.h).
 *
 *     verlet, composition8     M a matrix of numbers, f = f(q, t): H = T(p) + V(q, t), p = q'
 *     gauss4 ... gauss12       any, in (q, p) of sim/form/phase-space.h
 *     variational              the same, also with constraints on positions
 *
 * Tests  tests/script/methods/long-time-methods.lag, tests/bad/constraints/verlet-*.lag, variational-*.lag, gauss-mass.lag
 */
#ifndef QDOT_SIM_GEOMETRIC_H
#define QDOT_SIM_GEOMETRIC_H

#include "sim/model/equations.h"

/* Of a plan with M and f: set plan->halves or plan->phase_space. If its method is geometric and does
 * not fit: QDOT_ENOTBUILT, with the reason and a hint. */
QDOT_MUST_CHECK qdot_status qdot_plan_check_geometric(qdot_plan *plan, qdot_scene *scene,
                                                      qdot_run_treatment treatment);

#endif
