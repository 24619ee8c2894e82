/* run-start.h -- where a run begins and ends, and whether it can.
 *
 * Tests  as run.h
 */
#ifndef QDOT_SIM_RUN_START_H
#define QDOT_SIM_RUN_START_H

#include "sim/course/run-state.h"
#include "sim/model/request.h"

/* Read the limits and the start of the request into the run, whose stage is there; bring the start
 * onto the constraints; make the bind of the first mode and check the start by it. QDOT_EINVAL:
 * limits that are one double, a spring's negative rest length; QDOT_EDOMAIN: outside a domain;
 * those of qdot_start_settle and qdot_bind_check. */
QDOT_MUST_CHECK qdot_status qdot_run_start(qdot_run *run, qdot_scene *scene,
                                           const qdot_run_request *request);

/* After the run: add a notice that names the constraints found to be redundant. */
QDOT_MUST_CHECK qdot_status qdot_run_name_redundant(qdot_run *run, qdot_scene *scene,
                                                    const qdot_run_request *request);

#endif
