/* tree-series.h -- Taylor coefficients of the motion from d'Alembert's residual, by elimination along
 * its tree (residual-sweeps.h).
 *
 * Tests  tests/sim/form/test_taylor.c, test_residual-sweeps.c
 */
#ifndef QDOT_SIM_TREE_SERIES_H
#define QDOT_SIM_TREE_SERIES_H

#include "ode/system.h"
#include "sim/form/residual.h"
#include "sim/form/work.h"

typedef struct qdot_tree_series qdot_tree_series;

/* Of plan and residual with its programs, both borrowed (plan->residual need not be it);
 * *series NULL: it has no tree, or its program no vectors. `shaken` as for qdot_bind_new.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tree_series_new(const qdot_plan *plan,
                                                 const qdot_residual *residual, bool shaken,
                                                 qdot_tree_series **series);
void qdot_tree_series_free(qdot_tree_series *series);

/* The callbacks of the tree's Taylor series for the integrator (ode); borrowed. */
const qdot_ode_series *qdot_tree_series_get(const qdot_tree_series *series);

/* Convolutions an order. What its expansions consist of; whether the tree is one path; how
 * often M was eliminated. */
qdot_work qdot_tree_series_work(const qdot_tree_series *series);
double qdot_tree_series_convolutions(const qdot_tree_series *series);
bool qdot_tree_series_is_path(const qdot_tree_series *series);
size_t qdot_tree_series_eliminated(const qdot_tree_series *series);

#endif
