/* form.h -- which form of the equations is integrated: candidates, compared by what they cost.
 *
 * Without constraints M q'' = f and d'Alembert's residual, by its program or along its tree;
 * they are compared at a middling tolerance, as a plan is kept for runs under any. With
 * constraints their own coefficients, multipliers eliminated beforehand, and multipliers solved
 * for by machine code, compared at the tolerance of the run. For lanes and for numbers of many
 * digits, by what these executors take.
 *
 * Tests  tests/sim/plan/test_cost.c, test_bordered.c, test_constraints.c
 */
#ifndef QDOT_SIM_PLAN_FORM_H
#define QDOT_SIM_PLAN_FORM_H

#include "sim/model/equations.h"

/* plan->motion, convolutions and costs of M q'' = f, of a plan with a tape that is smooth:
 * the form that it has so far. Errors: those of the program; QDOT_ESINGULAR. */
QDOT_MUST_CHECK qdot_status qdot_plan_measure(qdot_plan *plan);

/* Choose the form of the equations for a smooth plan without constraints; everything else of the
 * plan is complete. */
QDOT_MUST_CHECK qdot_status qdot_plan_choose_form(qdot_plan *plan, qdot_scene *scene,
                                                  const qdot_run_request *request);
/* Choose the form of the equations of a plan with constraints. */
QDOT_MUST_CHECK qdot_status qdot_plan_choose_constrained(qdot_plan *plan,
                                                         const qdot_run_request *request);
/* The program and the costs of a plan for lanes: of its residual if it has one, else of
 * members, which becomes plan->motion. */
QDOT_MUST_CHECK qdot_status qdot_plan_make_lanes(qdot_plan *plan);
/* Choose whether Hamilton's equations are used for a run with `digits`. */
QDOT_MUST_CHECK qdot_status qdot_plan_choose_canonical(qdot_plan *plan,
                                                       qdot_scene *scene);

#endif
