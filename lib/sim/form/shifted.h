/* shifted.h -- Taylor coefficients of the motion from d'Alembert's residual
 * (residual.h).
 *
 * Tests  tests/sim/test_taylor.c, test_shifted-tree.c
 */
#ifndef QDOT_SIM_SHIFTED_H
#define QDOT_SIM_SHIFTED_H

#include "ode/system.h"
#include "sim/form/residual.h"

typedef struct qdot_shifted qdot_shifted;

/* Of plan and residual, both borrowed (plan->residual need not be it). `shaken` as for
 * qdot_bind_new. Errors: QDOT_ESINGULAR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_shifted_new(const qdot_plan *plan,
                                             const qdot_residual *residual, bool shaken,
                                             qdot_shifted **shifted);
void qdot_shifted_free(qdot_shifted *shifted);

/* Its callbacks; borrowed. */
const qdot_ode_series *qdot_shifted_series(const qdot_shifted *shifted);

/* Convolutions an order; how often M was factored. */
double qdot_shifted_convolutions(const qdot_shifted *shifted);
/* Whether like steps are taken as vectors (sim/form/shifted-wide.h, shifted-tree.h). */
bool qdot_shifted_is_wide(const qdot_shifted *shifted);
/* Nodes of the tree that M is eliminated along; 0: it is not. Whether they are one path. */
size_t qdot_shifted_tree_size(const qdot_shifted *shifted, bool *path);
size_t qdot_shifted_factored(const qdot_shifted *shifted);

#endif
