/* apart.h -- systems of parts that know nothing of each other, each integrated by steps of
 * its own.
 *
 *     y = parts' components by their index,   dy_k/dt = f_k(t, y_k)
 *
 * A run of such a system is as long as its shortest part: where one ends early the others
 * are known to its end.
 *
 * Tests  tests/sim/test_parts.c
 */
#ifndef QDOT_ODE_APART_H
#define QDOT_ODE_APART_H

#include "ode/integrate.h"
#include "ode/trajectory.h"

/* Whether it is to be integrated part by part: nobody looks at its steps as a whole. */
bool qdot_ode_is_apart(const qdot_ode_system *system, const qdot_ode_options *options);

/* As qdot_ode_integrate, which calls it. */
QDOT_MUST_CHECK qdot_status qdot_ode_apart_integrate(const qdot_ode_system *system,
                                                     const qdot_ode_method *method,
                                                     const qdot_ode_options *options,
                                                     double t0, double t1, double *y,
                                                     qdot_ode_result *result);

/* A trajectory, of one point so far, gone on with from y0 [n] to t1 as a track for each
 * part; the points of the whole become those of the part that took most steps. For
 * ode/trajectory.c. */
QDOT_MUST_CHECK qdot_status qdot_ode_apart_record(qdot_trajectory *tr,
                                                  const qdot_ode_system *system,
                                                  const qdot_ode_options *options,
                                                  double t1, const double *y0);

#endif
