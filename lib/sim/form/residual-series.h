/* residual-series.h -- Taylor coefficients of the motion from d'Alembert's residual
 * (residual.h): along its tree (residual-sweeps.h), or by the program of the motion
 * (motion-series.h), whichever is estimated to cost less.
 *
 * Tests  tests/sim/test_taylor.c, test_residual-sweeps.c
 */
#ifndef QDOT_SIM_RESIDUAL_SERIES_H
#define QDOT_SIM_RESIDUAL_SERIES_H

#include "ode/system.h"
#include "sim/form/residual.h"

typedef struct qdot_residual_series qdot_residual_series;

/* Of plan and residual, both borrowed (plan->residual need not be it). `shaken` as for
 * qdot_bind_new. Errors: QDOT_ESINGULAR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_residual_series_new(const qdot_plan *plan,
                                                     const qdot_residual *residual,
                                                     bool shaken,
                                                     qdot_residual_series **series);
void qdot_residual_series_free(qdot_residual_series *series);

/* Its callbacks; borrowed. */
const qdot_ode_series *qdot_residual_series_get(const qdot_residual_series *series);

/* Convolutions an order; how often M was factored. */
double qdot_residual_series_convolutions(const qdot_residual_series *series);
/* Bytes of machine code; 0: kernels run, *why says for what reason. */
size_t qdot_residual_series_code(const qdot_residual_series *series, const char **why);
/* Nodes of the tree that M is eliminated along; 0: it is not. Whether they are one path. */
size_t qdot_residual_series_tree_size(const qdot_residual_series *series, bool *path);
size_t qdot_residual_series_factored(const qdot_residual_series *series);

#endif
