/* momenta.h -- converts velocities to kept momenta and back, for the members of an
 * ensemble with a reduced plan (sim/plan/routh.h).
 *
 * A momentum is found by its tape in two doubles and rounded once.
 *
 * Tests  tests/sim/ensemble/test_ensemble.c
 */
#ifndef QDOT_SIM_ENSEMBLE_MOMENTA_H
#define QDOT_SIM_ENSEMBLE_MOMENTA_H

#include "sim/model/equations.h"

typedef struct qdot_ensemble_momenta qdot_ensemble_momenta; /* must not be shared between threads */

/* Make the conversion between velocities and conserved momenta for a reduced plan, borrowed.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_momenta_new(const qdot_plan *reduced,
                                                      qdot_ensemble_momenta **out);
void qdot_ensemble_momenta_free(qdot_ensemble_momenta *x);

/* Find the conserved momenta p [n_kept] at the state y [2n]; false if one is not finite. */
QDOT_MUST_CHECK bool qdot_ensemble_momenta_enter(qdot_ensemble_momenta *x, double t,
                                                 const double *y, double *p);
/* Compute the velocities in y that follow from p and its other components; not finite if they are
 * undefined. */
void qdot_ensemble_momenta_derive(qdot_ensemble_momenta *x, double t, const double *p,
                                  double *y);

#endif
