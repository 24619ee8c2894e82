/* motion-series.h -- Taylor coefficients of a single run from the program of its motion
 * (series/motion.h), stage by stage: by kernels, or as machine code.
 *
 * K is M, block by block, and factored with it where a series begins. Orders of q'' up to
 * QDOT_BLOCKS_SOLVED are solved for by that factor, those beyond by the inverse.
 *
 * Tests  tests/sim/test_taylor.c
 */
#ifndef QDOT_SIM_MOTION_SERIES_H
#define QDOT_SIM_MOTION_SERIES_H

#include "ode/system.h"
#include "series/motion.h"
#include "sim/model/equations.h"

typedef struct qdot_motion_series qdot_motion_series;

/* Of a motion whose inputs are q, q', t and whose unknowns are q'' of all coordinates of the plan,
 * block by block, and of M, as lower triangles of the blocks that are not constant, from the same
 * inputs; all borrowed. `shaken` as for qdot_bind_new. Errors: QDOT_ESINGULAR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_motion_series_new(const qdot_plan *plan,
                                                   const qdot_motion *motion,
                                                   const qdot_tape *masses, bool shaken,
                                                   qdot_motion_series **series);
void qdot_motion_series_free(qdot_motion_series *series);

/* Its callbacks; borrowed. */
const qdot_ode_series *qdot_motion_series_get(const qdot_motion_series *series);

/* How often M was factored; bytes of machine code, 0: there is none, *why says so. */
size_t qdot_motion_series_factored(const qdot_motion_series *series);
size_t qdot_motion_series_code(const qdot_motion_series *series, const char **why);

#endif
