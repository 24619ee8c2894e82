/* apart.h -- systems of decoupled parts, each integrated with its own steps.
 *
 *     y = components of all parts by their index,   dy_k/dt = f_k(t, y_k)
 *
 * A run of such a system ends with its shortest part: if one part ends early, so does the run.
 * For ode/ alone.
 *
 * Tests  tests/sim/plan/test_parts.c
 */
#ifndef QDOT_ODE_APART_H
#define QDOT_ODE_APART_H

#include "ode/run.h"

/* Whether the parts of the system are integrated separately: it has parts, and no callback observes
 * its steps. */
bool qdot_ode_is_apart(const qdot_ode_system *system, const qdot_ode_options *options);

/* Copy the components of a decoupled part out of y into the part's state; the second function copies them back. */
void qdot_ode_part_gather(const qdot_ode_part *part, const double *y, double *own);
void qdot_ode_part_scatter(const qdot_ode_part *part, const double *own, double *y);

/* The options for a part; carry [n] is space for its carry, and at the end for its end state less
 * y. */
qdot_ode_options qdot_ode_part_options(const qdot_ode_part *part,
                                       const qdot_ode_options *whole, double *carry);

/* Add the counts of steps and evaluations of a part to those of the whole. */
void qdot_ode_part_add(qdot_ode_result *whole, const qdot_ode_result *part);
/* If the integration of a part ended early, end the whole integration at that time. */
void qdot_ode_part_end(qdot_ode_result *whole, const qdot_ode_result *part);

#endif
