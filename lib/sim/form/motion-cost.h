/* motion-cost.h -- what expansions of a motion cost, by kernels and as machine code.
 *
 * Nanoseconds, as measured on a machine of 2023; only their ratios matter. cost[0] + cost[1] p +
 * cost[2] p^2 is what an expansion to order p takes (ode/system.h).
 *
 * Tests  tests/sim/test_taylor.c
 */
#ifndef QDOT_SIM_MOTION_COST_H
#define QDOT_SIM_MOTION_COST_H

#include "ode/system.h"
#include "series/taylor.h"
#include "sim/form/blocks.h"
#include "sim/form/saddle-solver.h"

typedef struct {
    const qdot_taylor *taylor;  /* its program */
    const qdot_blocks *solvers; /* of what is solved for */
    const qdot_tape *tape;      /* of the equations; of a residual that of M */
} qdot_motion_work;

/* Equations that are explicit (series/motion.h): kernels; then code, as far as its callbacks are
 * there. */
void qdot_motion_cost_explicit(const qdot_motion_work *of, qdot_ode_series *series);
/* Of these bordered by constraints, which are code only. */
void qdot_motion_cost_bordered(const qdot_motion_work *of, qdot_ode_series *series);
/* Of constraints by their own coefficients, solved by this. */
void qdot_motion_cost_constrained(const qdot_motion_work *of, const qdot_saddle_solver *solver,
                                  qdot_ode_series *series);
/* Equations that the steps write. */
void qdot_motion_cost_implicit(const qdot_motion_work *of, qdot_ode_series *series);

#endif
