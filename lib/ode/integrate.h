/* integrate.h -- integration from t0 to t1 with a bound for the error of every step.
 *
 *     |error of y_i in one step| <= tol max(s_i, |y_i|),   every component, every step
 *
 * (as the method estimates it). t1 < t0 runs backwards. The last step ends on t1 to the
 * bit; time and, for one-step methods, the state are accumulated as sums of two doubles,
 * so that rounding grows like a random walk of evaluations and not of additions.
 *
 * With ratio the largest error of a step over its bound, the step is accepted if
 * ratio <= 1, and the next one is h 0.9 (ratio/0.1)^(-1/p), within a factor 0.2 to 5: it
 * aims at a tenth of the tolerance. p is the power of h in the method's own error
 * estimate (Hairer, Norsett & Wanner I, II.4, eq. 4.13); multistep methods keep their
 * step unless it may grow by a half. The first one is chosen by Hairer's rule (same,
 * "starting step size").
 *
 * A tolerance is a local bound; companion.h estimates the error of the end state.
 *
 * Tests  tests/ode/test_integrate.c
 */
#ifndef QDOT_ODE_INTEGRATE_H
#define QDOT_ODE_INTEGRATE_H

#include "ode/run.h"

/* Integrate y [n, in/out] from t0 to t1.
 *
 * Whatever is returned, y is the state at result->t, finite, and everything accepted on
 * the way has been passed to options->accepted. Who wants to look inside steps goes along a controller (step.h).
 *   options  NULL: all defaults
 * Returns QDOT_OK (done or stopped), or with outcome failed:
 *   QDOT_EINVAL   tolerance, limits or initial state make no sense (t = t0)
 *   QDOT_EFAILED  at some t no step is small enough: f is undefined, not finite or
 *                 singular beyond it, or the step fell below 16 spacings of the numbers
 *                 near t
 *   QDOT_ELIMIT   max_steps
 *   QDOT_EINTR    an interruption (base/interrupt.h), looked at before every step
 *   QDOT_ENOMEM, or what f, the Jacobian or `accepted` returned
 * and the message recorded is result->reason. */
QDOT_MUST_CHECK qdot_status qdot_ode_integrate(const qdot_ode_system *system,
                                               const qdot_ode_method *method,
                                               const qdot_ode_options *options, double t0,
                                               double t1, double *y,
                                               qdot_ode_result *result);

#endif
