/* guarded.h -- a fast series where its equations are well conditioned, another one elsewhere.
 *
 * Under constraints the fast forms (bordered.h, eliminated.h) solve without pivots or corrections.
 * At a state that is not for them the other series is begun instead: of the bordered one where its
 * `begin` fails with QDOT_EDOMAIN, of the eliminated one where a pivot is small beside the diagonal.
 *
 * Tests  tests/sim/form/test_bordered.c, tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_GUARDED_H
#define QDOT_SIM_GUARDED_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_guarded qdot_guarded;

/* Of a plan with constraints: `fast` is plan->eliminated, or the plan itself, which is bordered; and the
 * series of its constraints; all borrowed. `shaken` as for qdot_bind_new. Errors: those of
 * qdot_motion_series_new. */
QDOT_MUST_CHECK qdot_status qdot_guarded_new(const qdot_plan *plan, const qdot_plan *fast,
                                             bool shaken, const qdot_ode_series *other,
                                             qdot_guarded **guarded);
void qdot_guarded_free(qdot_guarded *guarded);

/* The callbacks of the guarded series for the integrator (ode); borrowed. */
const qdot_ode_series *qdot_guarded_series(const qdot_guarded *guarded);

/* The length of the machine code in bytes; 0 if there is none, and then *why is the reason. */
size_t qdot_guarded_code(const qdot_guarded *guarded, const char **why);

#endif
