/* long-run.h -- under what tolerance `auto` makes a run of many steps.
 *
 * The truncation of a Taylor series errs to the same side in every period: under tol 1e-12 the energy
 * drifts as t, and the phase as t^2. Rounding does neither: it is a random walk. So where more than
 * QDOT_LONG_STEPS steps are foreseen, and the first orders of the series can be sums of two doubles
 * (ode/leading.h), the tolerance is QDOT_LONG_TOL: truncation stays below rounding, at two to three
 * times the work.
 *
 * Tests  tests/script/methods/long-run.lag
 */
#ifndef QDOT_SIM_LONG_RUN_H
#define QDOT_SIM_LONG_RUN_H

#include "ode/system.h"
#include "sim/model/equations.h"

#define QDOT_LONG_STEPS 2e4
#define QDOT_LONG_TOL 3e-16

/* A run whose number of steps is to be predicted. */
typedef struct {
    const qdot_plan *plan;
    const qdot_ode_system *system;
    const double *start, *low; /* [2n] the exact start state is start + low */
    double t0, t1, tol;
} qdot_long_run;

/* *tol: QDOT_LONG_TOL, or run->tol where the run is no such run: not by series, not the choice of
 * `auto`, under another tolerance than the one that nobody has asked for, with constraints, too long
 * to be stored with its low parts. The first steps are made for it, if the run can be long at all.
 * Errors: QDOT_EINTR, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_long_run_tolerance(const qdot_long_run *run, double *tol);

#endif
