/* splitting.h -- lengths of the steps of a composition.
 *
 * Tests  tests/ode/geometric/test_geometric.c
 */
#ifndef QDOT_ODE_SPLITTING_H
#define QDOT_ODE_SPLITTING_H

enum { QDOT_COMPOSITION_STAGES = 17 };

/* The lengths g_i h of the stages [17] of composition.def. Doubles do not add up to h: *rest, to be
 * added to the middle one, makes the sum exact. */
void qdot_composition_lengths(double h, double *length, double *rest);

#endif
