/* companion.h -- how wrong is the end of a run? A second run tells.
 *
 * Let y be the end state of a run under tol from y0. Its companion goes the same way
 *
 *     by the partner of the method (method.h),
 *     under tol* = tol/100 (tol/10^4 for bsimp, whose error follows tol only roughly),
 *       not below the method's companion_tol. A method that is its own partner and would
 *       not get 4 times tighter takes tol* = 10 max(tol, companion_tol): then the
 *       companion errs more, on the safe side (a tighter one would share the rounding of
 *       the coefficients, which is a drift and no noise). taylor, whose coefficients
       are computed and not rounded once for all, takes tol/100 down to 1e-16, and three
       orders more than that asks for,
 *     from y0_i +- 2^-53 max(1, |y0_i|), signs mixed, and always another double
 *
 * to y*. The tighter tolerance shows the error of the method, the moved start the
 * rounding of the inputs (its zeros too) and, as all roundings of the second run differ,
 * that of the run itself.
 *
 *     difference_i = |y_i - y*_i|
 *     error        = max(2^-53, max_i difference_i / max(1, |y_i|))
 *
 * An estimate, not a bound: where rounding is all there is, two random walks are
 * compared. Measured on 1560 runs (pendulum, Henon-Heiles, Kepler e = 0.5; t = 7 to 125;
 * all methods; tol 1e-6 to 1e-16): stated / true lay between 0.6 and 62; it is near 1
 * wherever the companion has the tighter tolerance. tests/ode/test_companion.c holds a
 * part of them. A start far below 1 in size is moved by far more than its own rounding:
 * in Kepler's problem from x = 0.01 the statement does not fall below 2e-10, 400 times
 * the error of a run at tol 1e-15.
 *
 * A companion that does not arrive gives no number: known is false, the error a NaN.
 *
 * Numbers that enter f (parameters) are moved by the caller, in the companion's own
 * system; likewise a limit that is not a double exactly: pass its neighbour as the
 * companion's t1.
 */
#ifndef QDOT_ODE_COMPANION_H
#define QDOT_ODE_COMPANION_H

#include <stdbool.h>

#include "base/status.h"
#include "ode/integrate.h"

typedef struct {
    bool known;
    double error;           /* as above; NaN where unknown */
    double tol;             /* tol* */
    qdot_ode_result result; /* of the companion: its cost, why it did not arrive */
} qdot_companion_estimate;

typedef struct qdot_companion qdot_companion;

/* The moved start of a system that projects is projected.
 *
 * Begin the companion of a run of `method` under `tol` from y0 [n] at t0 to t1.
 *   system    for the companion alone if `threaded`; borrowed until _finish
 *   threaded  run it on a second thread beside the caller; if none can be had, or false,
 *             it runs within _finish
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_companion_start(const qdot_ode_system *system,
                                                 const qdot_ode_method *method,
                                                 double tol, double t0, double t1,
                                                 const double *y0, bool threaded,
                                                 qdot_companion **out);

/* Where rounding is all there is, the difference at one time may be small by chance: in
 * one dimension two random walks meet. So the companion of a run by Taylor series looks
 * at some times of its latter half too, in the order of the run, and the error becomes
 *
 *     max(error at the end, median of the errors at those times)
 *
 * once the run has shown its states there; *count is 0 for other methods. */
const double *qdot_companion_times(const qdot_companion *c, size_t *count);

/* The state y [n] of the run at time k of those; copied. */
void qdot_companion_show(qdot_companion *c, size_t k, const double *y);

/* The run itself has ended at t_end with y [n]: wait for the companion (that of a run
 * which ended before t1 starts again, to t_end), compare, and free it.
 *   difference  [n] out, may be NULL; NaN where unknown
 * Never fails: what goes wrong makes the error unknown, result.reason says why. */
void qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                           double *difference, qdot_companion_estimate *out);

/* Orders more that a companion by Taylor series takes (qdot_ode_options.order_more). */
#define QDOT_COMPANION_ORDERS 3

/* The tolerance tol* of a companion. */
double qdot_companion_tolerance(const qdot_ode_method *method, double tol);

#endif
