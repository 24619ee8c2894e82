/* momenta.h -- the momenta that a reduced plan (sim/plan/routh.h) keeps, and the velocities that
 * follow from them.
 *
 * Tests  tests/sim/test_routh.c
 */
#ifndef QDOT_SIM_MOMENTA_H
#define QDOT_SIM_MOMENTA_H

#include "ode/system.h"
#include "sim/model/equations.h"

typedef struct qdot_momenta qdot_momenta; /* one a thread */

/* Of a reduced plan, borrowed. `tape`: its tape or a shaken one, borrowed. */
QDOT_MUST_CHECK qdot_status qdot_momenta_new(const qdot_plan *reduced,
                                             const qdot_tape *tape, qdot_momenta **momenta);
void qdot_momenta_free(qdot_momenta *m);

/* The velocities [n_kept], in out, that follow from momenta p [n_kept] at (t, y [2n]), by `tape`, the
 * reduced plan's or a shaken one; in, out and work are its inputs, outputs and work space. */
const double *qdot_momenta_rates(const qdot_plan *reduced, const qdot_tape *tape, double t,
                                 const double *y, const double *p, double *in, double *out,
                                 double *work);

/* The callbacks by which they are entered and velocities derived; borrowed. */
const qdot_ode_following *qdot_momenta_following(const qdot_momenta *m);

/* What is kept is hi + lo [n_kept] each: borrowed, changed by `enter`. */
const double *qdot_momenta_hi(const qdot_momenta *m);
const double *qdot_momenta_lo(const qdot_momenta *m);

#endif
