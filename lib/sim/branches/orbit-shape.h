/* orbit-shape.h -- how far an orbit reaches, read from the latest run of a response whose expressions are q, q', q''
 * [3n], then an energy if there is one (orbit-path.h); from t0 on, over T.
 *
 * Tests  tests/sim/test_orbits.c
 */
#ifndef QDOT_SIM_ORBIT_SHAPE_H
#define QDOT_SIM_ORBIT_SHAPE_H

#include "sim/study/response.h"

/* The largest value of each coordinate [n]: q' = 0 within the largest of a few hundred places; *size: the largest half
 * of a change of a coordinate. */
QDOT_MUST_CHECK qdot_status qdot_orbit_shape(qdot_response *r, size_t n, bool energy, double t0,
                                             double T, double *most, double *size);
/* Half of the change of each of q, q' [2n]. */
QDOT_MUST_CHECK qdot_status qdot_orbit_changes(qdot_response *r, size_t n, bool energy, double t0,
                                               double T, double *change);
/* The state z [2n] where the coordinate that changes most turns; *phase: the place of its velocity. */
QDOT_MUST_CHECK qdot_status qdot_orbit_turn(qdot_response *r, size_t n, bool energy, double t0,
                                            double T, size_t *phase, double *z);

#endif
