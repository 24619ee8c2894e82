/* precise-start.h -- solves for the start of a run with `digits`, in all its digits.
 *
 * The values that a start does not name follow from the constraints. If these determine them, the
 * state in doubles that keeps the constraints is improved by Newton's method with residuals in
 * MPFR and derivatives in doubles,
 *
 *     A_free dx = -F(x),   A_free: the columns of what was not named, of full rank,
 *
 * some 15 digits a step, first positions, then velocities. Named values stay as they are written.
 *
 * Tests  tests/script/digits/digits-start.lag, tests/bad/digits/digits-constraint.lag
 */
#ifndef QDOT_SIM_PRECISE_START_H
#define QDOT_SIM_PRECISE_START_H

#include <mpfr.h>

#include "sim/model/equations.h"

/* start [2 + 2n]: t0, one unused number, q and q' as given; y [2n]: the state in doubles, on the
 * constraints. Values stay as they are if they break the constraints by less than 2^enough or if
 * the constraints do not determine them: the caller must check that the constraints hold, and
 * may find the nearest ones (precise-hold.h). Errors:
 * QDOT_ENOMEM, those of a constant, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_precise_start_solve(const qdot_plan *plan,
                                                     const qdot_run_request *request,
                                                     const double *y, double enough,
                                                     mpfr_prec_t bits, mpfr_t *start);

#endif
