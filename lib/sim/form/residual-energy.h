/* residual-energy.h -- h = T + V by the sums of d'Alembert's residual.
 *
 *     x_f' = x_parent' + d_f',   T = 1/2 sum w x' y',   V = -sum w g x + ...
 *
 * with places and rates summed up from the roots: of the order of N operations for a chain of N
 * links, where T by M takes N^2.
 *
 * Tests  tests/sim/plan/test_tree-alone.c: against mech's energy
 */
#ifndef QDOT_SIM_RESIDUAL_ENERGY_H
#define QDOT_SIM_RESIDUAL_ENERGY_H

#include "sim/form/residual.h"

/* V with the values put in. Errors: those of deriving. */
QDOT_MUST_CHECK qdot_status qdot_residual_potential(qdot_scene *scene, const qdot_plan *plan,
                                                    const qdot_residual *residual, qdot_expr *V);
/* Into residual->h, ->energy and ->absent, the values put in; these stay as they are where places
 * hold t: what Lagrange's equations conserve is not T + V there. Errors: those of deriving. */
QDOT_MUST_CHECK qdot_status qdot_residual_add_energy(qdot_scene *scene, const qdot_plan *plan,
                                                     qdot_residual *residual);

#endif
