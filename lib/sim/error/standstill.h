/* standstill.h -- whether a motion is lost because it comes near an unstable equilibrium.
 *
 * With f the slopes of the state and F_i the largest |f_i| along the run,
 *
 *     max_i |f_i| / F_i < 1e-2
 *
 * at a point before the horizon: all of the state nearly stands still there. Motions beside it leave
 * to one side or the other, so it is undecided what follows. A chaotic motion seldom has all its
 * slopes that small at once. Only of equations in which time does not occur: a drive pushes a motion on from where it
 * stands still, and decides the side.
 *
 * Tests  tests/script/studies/chaos.sh
 */
#ifndef QDOT_SIM_STANDSTILL_H
#define QDOT_SIM_STANDSTILL_H

#include "sim/course/run-state.h"

/* The time of the stored point before the horizon where that is least; NaN if it is above the
 * bound. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_standstill_find(const qdot_run *run, double *t);

#endif
