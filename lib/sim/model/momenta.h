/* momenta.h -- the momenta that a reduced plan (sim/plan/routh.h) keeps, and the velocities that
 * follow from them.
 *
 * Tests  tests/sim/plan/test_routh.c
 */
#ifndef QDOT_SIM_MOMENTA_H
#define QDOT_SIM_MOMENTA_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_momenta qdot_momenta; /* must not be shared between threads */

/* Make the conserved momenta of a reduced plan (borrowed); `tape`: its own or a perturbed one, borrowed. */
QDOT_MUST_CHECK qdot_status qdot_momenta_new(const qdot_plan *reduced,
                                             const qdot_tape *tape, qdot_momenta **momenta);
void qdot_momenta_free(qdot_momenta *m);

/* A tape of a reduced plan (its own, or one with perturbed constants) with work space to evaluate it. */
typedef struct {
    const qdot_plan *plan;
    const qdot_tape *tape;
    double *in, *out, *work;
} qdot_momenta_tape;

QDOT_MUST_CHECK qdot_status qdot_momenta_tape_init(qdot_momenta_tape *e,
                                                   const qdot_plan *reduced,
                                                   const qdot_tape *tape);
void qdot_momenta_tape_clear(qdot_momenta_tape *e);

/* Compute the velocities [n_kept], borrowed, that follow from momenta p [n_kept] at (t, y [2n]). */
const double *qdot_momenta_rates(qdot_momenta_tape *e, double t, const double *y,
                                 const double *p);

/* Callbacks that compute the momenta of a start, and velocities from momenta; borrowed. */
const qdot_ode_following *qdot_momenta_following(const qdot_momenta *m);

/* The conserved momenta hi + lo, [n_kept] each: borrowed; the callback `enter` changes them. */
const double *qdot_momenta_hi(const qdot_momenta *m);
const double *qdot_momenta_lo(const qdot_momenta *m);

#endif
