/* variation-scene.h -- writes the scene of variational equations and its start (variation.h). */
#ifndef QDOT_SIM_VARIATION_SCENE_H
#define QDOT_SIM_VARIATION_SCENE_H

#include "sim/study/variation-parts.h"

/* Write the variational scene and its start; its equations are y'' = b [k x n] for all directions. */
QDOT_MUST_CHECK qdot_status qdot_variation_write(qdot_variation *v, const qdot_expr *b);

/* The request of the variational run: the given one with the start of v. Borrows from both. */
qdot_run_request qdot_variation_request(const qdot_variation *v);

/* QDOT_EINVAL if y [2 (k + 1) n], its start brought onto the constraints, has moved slopes of values that the start
 * names: constraints let no such value change alone. The same of its run. */
QDOT_MUST_CHECK qdot_status qdot_variation_check_state(const qdot_variation *v,
                                                       const double *y);
QDOT_MUST_CHECK qdot_status qdot_variation_check_start(const qdot_variation *v,
                                                       qdot_run *run);

#endif
