/* orbit-shape.h -- how far an orbit reaches, read from its segments (flow.h).
 *
 * Tests  tests/sim/branches/test_orbits.c
 */
#ifndef QDOT_SIM_ORBIT_SHAPE_H
#define QDOT_SIM_ORBIT_SHAPE_H

#include "sim/study/flow.h"

typedef struct {
    qdot_flow *flow;
    const qdot_flow_orbit *orbit;
    size_t at; /* index of the segment integrated last by `flow`; SIZE_MAX: none */
} qdot_orbit_read;

/* The largest value of each coordinate [n]: q' = 0 within the largest of a few hundred places; *size: the largest half
 * of a change of a coordinate. */
QDOT_MUST_CHECK qdot_status qdot_orbit_shape(qdot_orbit_read *r, double *most, double *size);
/* Find half of the range of each component of q and q' over the orbit: change [2n]. */
QDOT_MUST_CHECK qdot_status qdot_orbit_changes(qdot_orbit_read *r, double *change);
/* The state z [2n] at a turning point of the coordinate that changes most; *phase: the index of its
 * velocity. */
QDOT_MUST_CHECK qdot_status qdot_orbit_turn(qdot_orbit_read *r, size_t *phase, double *z);

#endif
