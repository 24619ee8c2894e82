/* apart.h -- systems of parts that know nothing of each other, each integrated by steps of
 * its own.
 *
 *     y = parts' components by their index,   dy_k/dt = f_k(t, y_k)
 *
 * A run of such a system is as long as its shortest part: where one ends early the others
 * are known to its end. For ode/ alone.
 *
 * Tests  tests/sim/test_parts.c
 */
#ifndef QDOT_ODE_APART_H
#define QDOT_ODE_APART_H

#include "ode/run.h"

/* Whether it is to be integrated part by part: nobody looks at its steps as a whole. */
bool qdot_ode_is_apart(const qdot_ode_system *system, const qdot_ode_options *options);

/* The part's own components of y; its own put into y. */
void qdot_ode_part_gather(const qdot_ode_part *part, const double *y, double *own);
void qdot_ode_part_scatter(const qdot_ode_part *part, const double *own, double *y);

/* What one of them is integrated with; carry [n] is room for its own, in the end for what its
 * end state is beyond y. */
qdot_ode_options qdot_ode_part_options(const qdot_ode_part *part,
                                       const qdot_ode_options *whole, double *carry);

/* What the whole did, once a part has done its. */
void qdot_ode_part_add(qdot_ode_result *whole, const qdot_ode_result *part);
/* Where a part ends early the whole does. */
void qdot_ode_part_end(qdot_ode_result *whole, const qdot_ode_result *part);

#endif
