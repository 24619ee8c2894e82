/* ensemble-momenta.h -- momenta in place of velocities, state by state: for the members of an ensemble
 * by a reduced plan (sim/plan/routh.h).
 *
 * A momentum is found by its tape in two doubles and rounded once.
 *
 * Tests  tests/sim/test_ensemble.c
 */
#ifndef QDOT_SIM_ENSEMBLE_MOMENTA_H
#define QDOT_SIM_ENSEMBLE_MOMENTA_H

#include "sim/model/equations.h"

typedef struct qdot_ensemble_momenta qdot_ensemble_momenta; /* one a thread */

/* Of a reduced plan, borrowed. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_momenta_new(const qdot_plan *reduced,
                                                      qdot_ensemble_momenta **out);
void qdot_ensemble_momenta_free(qdot_ensemble_momenta *x);

/* The momenta p [n_kept] that are kept from y [2n] on; false where one is not finite. */
QDOT_MUST_CHECK bool qdot_ensemble_momenta_enter(qdot_ensemble_momenta *x, double t,
                                                 const double *y, double *p);
/* The velocities that follow from p and y's other components, into y; not finite where they are
 * undefined. */
void qdot_ensemble_momenta_derive(qdot_ensemble_momenta *x, double t, const double *p,
                                  double *y);

#endif
