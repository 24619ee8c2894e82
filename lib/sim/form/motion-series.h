/* motion-series.h -- Taylor coefficients of a single run from the program of its motion
 * (series/motion.h), stage by stage: by kernels, or as machine code.
 *
 * What is solved for, of M q'' = f, d'Alembert's residual or constraints: motion-matrix.h.
 *
 * Tests  tests/sim/form/test_taylor.c, test_motion.c, test_bordered.c
 */
#ifndef QDOT_SIM_MOTION_SERIES_H
#define QDOT_SIM_MOTION_SERIES_H

#include "ode/system.h"
#include "series/motion.h"
#include "sim/form/work.h"
#include "sim/model/equations.h"

typedef struct qdot_motion_series qdot_motion_series;

/* Of a plan's M q'' = f, plan->motion. `shaken` as for qdot_bind_new. Errors: QDOT_ESINGULAR,
 * QDOT_ENOMEM; where an expansion begins QDOT_EDOMAIN, also of constraints that depend on each
 * other: if they do so at the first state no code is written. */
QDOT_MUST_CHECK qdot_status qdot_motion_series_new(const qdot_plan *plan, bool shaken,
                                                   qdot_motion_series **series);
/* Of a motion that is not explicit, whose inputs are q, q', t and whose unknowns are q'' of all
 * coordinates of the plan, block by block, and of M, as lower triangles of the blocks that are not
 * constant, from the same inputs; all borrowed. */
QDOT_MUST_CHECK qdot_status qdot_motion_series_of_residual(const qdot_plan *plan,
                                                           const qdot_motion *motion,
                                                           const qdot_tape *masses, bool shaken,
                                                           qdot_motion_series **series);
/* Of a plan with constraints, by their own coefficients (motion-of-constraints.h). Errors: those of
 * the plan's constraints, where an expansion begins; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_motion_series_of_constraints(const qdot_plan *plan, bool shaken,
                                                              qdot_motion_series **series);
void qdot_motion_series_free(qdot_motion_series *series);

/* Of a reduced plan (sim/plan/routh.h): the momenta hi + lo [n_kept], borrowed and read wherever
 * an expansion begins. */
void qdot_motion_series_keep(qdot_motion_series *series, const double *hi, const double *lo);

/* The callbacks of the Taylor series for the integrator (ode); borrowed. */
const qdot_ode_series *qdot_motion_series_get(const qdot_motion_series *series);

/* The Taylor coefficients of output i of the series program. */
const double *qdot_motion_series_output(const qdot_motion_series *series, size_t i);

/* The counts of operations in an expansion of the motion. */
qdot_work qdot_motion_series_work(const qdot_plan *plan);
qdot_work qdot_motion_series_work_of_residual(const qdot_plan *plan, const qdot_motion *motion,
                                              const qdot_tape *masses);
/* The counts of operations in an expansion with constraints. */
qdot_work qdot_motion_series_work_of_constraints(const qdot_motion_series *series);

/* The number of times K was factored; qdot_motion_series_code: bytes of machine code, 0 and *why if none. */
size_t qdot_motion_series_factored(const qdot_motion_series *series);
size_t qdot_motion_series_code(const qdot_motion_series *series, const char **why);

#endif
