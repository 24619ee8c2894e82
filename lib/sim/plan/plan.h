/* plan.h -- how a scene is integrated: method, form of the equations, parts.
 *
 * Tests  tests/sim/run/test_run.c
 */
#ifndef QDOT_SIM_PLAN_H
#define QDOT_SIM_PLAN_H

#include "sim/form/derived.h"

/* Check that a scene can be integrated at all. Errors: QDOT_EINVAL, QDOT_ENOTBUILT. */
QDOT_MUST_CHECK qdot_status qdot_plan_check(const qdot_scene *scene);

/* Make the plan of a run. Errors: those of qdot_run_new before integration, except for the start state. */
QDOT_MUST_CHECK qdot_status qdot_plan_new(qdot_scene *scene,
                                          const qdot_run_request *request,
                                          qdot_plan **plan);
/* The same with the equations frozen to one side of every surface (sim/model/switch.h). Of
 * equations that switch _new takes M and f as they stand: no method by Taylor series. */
QDOT_MUST_CHECK qdot_status qdot_plan_in_mode(qdot_scene *scene,
                                              const qdot_run_request *request,
                                              const struct qdot_switches *switches,
                                              const int64_t *side, qdot_plan **plan);

#endif
