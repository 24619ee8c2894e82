/* cost.h -- what steps cost, by form and by executor: one table of models for all decisions.
 *
 * An expansion to order p takes about c[0] + c[1] p + c[2] p^2 nanoseconds, as on a machine of
 * 2023; only their ratios matter. c is linear in what a form counts of itself
 * (sim/form/work.h), with coefficients fitted to scenes, as the table in cost.c says. A
 * qdot_ode_cost is the model that the order of a run is chosen by, and it says when machine
 * code pays (ode/system.h).
 *
 * Of a step more is known than of an expansion: states are projected behind it.
 *
 * Tests  tests/sim/plan/test_cost.c
 */
#ifndef QDOT_SIM_COST_H
#define QDOT_SIM_COST_H

#include <mpfr.h>

#include "ode/system.h"
#include "sim/form/work.h"

/* M q'' = f, d'Alembert's residual by its program, the same along its tree; with constraints: by
 * their own coefficients. */
qdot_ode_cost qdot_cost_explicit(const qdot_work *work);
qdot_ode_cost qdot_cost_implicit(const qdot_work *work);
qdot_ode_cost qdot_cost_tree(const qdot_work *work);
qdot_ode_cost qdot_cost_constrained(const qdot_plan *plan, const qdot_work *work);
/* Multipliers eliminated beforehand, which is M q'' = f with that work; multipliers solved for by
 * machine code, which is begun by the kernels of `other`. */
qdot_ode_cost qdot_cost_eliminated(const qdot_plan *plan, const qdot_work *work);
qdot_ode_cost qdot_cost_bordered(const qdot_work *work, const qdot_ode_cost *other);
/* At least, of M q'' = f with a full block of n coordinates and no more than so many
 * convolutions. */
qdot_ode_cost qdot_cost_least(size_t n, double convolutions);
/* The cost of expanding a motion in vector lanes, for eight ensemble members together. */
qdot_ode_cost qdot_cost_lanes(const qdot_work *work);
/* Estimate the cost of a plan's steps in MPFR (option `digits`) with that precision. */
void qdot_cost_precise(const qdot_plan *plan, mpfr_prec_t bits, double cost[3]);

/* The cost of projecting the state onto the constraints after a step. */
double qdot_cost_projection(const qdot_plan *plan);

/* The cost of the same steps without machine code, by compiled kernels only. */
qdot_ode_cost qdot_cost_of_kernels(const qdot_ode_cost *cost);
/* Steps of a way as long as the radius of convergence, at a middling tolerance: forms are
 * compared at one, for a plan is kept for runs under any. */
double qdot_cost_steps(const qdot_ode_cost *cost);
/* The cost of steps with constraints at a given tolerance, including the projection after every step. */
double qdot_cost_constrained_steps(const qdot_plan *plan, const qdot_ode_cost *cost, double tol);
/* The cost of one evaluation of a tape. */
double qdot_cost_evaluation(const qdot_tape *tape);

#endif
