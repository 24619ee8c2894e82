/* precise-start.h -- a start that is solved for, in all the digits of a run.
 *
 * The values that a start does not name follow from the constraints. Where these determine them,
 * the state of doubles that keeps the constraints is brought onto them by Newton's method with
 * residuals in MPFR and slopes in doubles,
 *
 *     A_free dx = -F(x),   A_free: the columns of what was not named, of full rank,
 *
 * some 15 digits a step, first positions, then velocities. Named values stay as they are written.
 *
 * Tests  tests/script/digits-start.lag, tests/bad/digits-constraint.lag
 */
#ifndef QDOT_SIM_PRECISE_START_H
#define QDOT_SIM_PRECISE_START_H

#include <mpfr.h>

#include "sim/model/equations.h"

/* start: t0, then q and q' behind one number that is not looked at, [2 + 2n], as given; y [2n]: in
 * doubles, on the constraints. What breaks them by less than 2^enough stays as it is, and so does
 * what they do not determine: whoever wants them kept has to look. Errors: QDOT_ENOMEM, those of a
 * constant, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_precise_start_solve(const qdot_plan *plan,
                                                     const qdot_run_request *request,
                                                     const double *y, double enough,
                                                     mpfr_prec_t bits, mpfr_t *start);

#endif
