/* companion.h -- how wrong is the end of a run? A second run tells.
 *
 * Let y be the end state of a run under tol from y0. Its companion goes the same way
 *
 *     by Taylor series where the system has them, else by the partner of the method
 *       (method.h); beside a stiff method by the partner too where series get stuck,
 *     under tol* = tol/100 (tol/10^4 for msbdf; tol/10^10 for bsimp, which at
 *       loose tolerances is better than they ask for by as much), not below the method's
 *       companion_tol. A method that is its own partner and would not get 4 times tighter
 *       takes tol* = 10 max(tol, companion_tol): then the companion errs more, on the safe
 *       side (a tighter one would share the rounding of the coefficients, which is a drift
 *       and no noise). taylor, whose coefficients
 *       are computed and not rounded once for all, takes tol/100 down to 1e-16, and three
 *       orders more than that asks for,
 *     from the doubles next to y0, +-2^-53 for a zero, signs mixed,
 *
 * to y*. The tighter tolerance shows the error of the method, the moved start the
 * rounding of the inputs (its zeros too) and, as all roundings of the second run differ,
 * that of the run itself.
 *
 *     apart_i = max_k |y_i - y*_k,i|,   own_i = |y*_1,i - y*_2,i|
 *     error   = max(floor, bound(apart, own))     (qdot_companion_bound)
 *     floor   = 2^-52 min(sqrt(steps), 32)
 *
 * where a distance of states is max_i |a_i - b_i| / max(1, min(|a_i|, |b_i|)).
 *
 * Two companions, moved to either side, by one order more and by three: where rounding is all
 * there is the difference of two random walks may be small by chance, and near an instability
 * everything is one number; where the tolerance rules, a method may be so much better than it asks
 * for that a companion errs as much as the run.
 *     The second one is there for what chance cannot hide: the amplification of the scene. It
 * starts QDOT_COMPANION_FAR doubles away (zeros stay 2^-53 away: of their scale nothing is
 * known), and of its distances min(1, sqrt(steps)/QDOT_COMPANION_FAR) counts, what a random
 * walk of one rounding a step would have moved the start by.
 *
 *     A run whose first orders are sums of two doubles (leading.h) takes its inputs as they are
 * written and errs by far less than a rounding a step. Its companions, of the same kind, start
 *
 *     QDOT_COMPANION_AIMS eps max(1, |y_i|)
 *
 * away, and three times that, eps being what a step of it may err by; the floor is 2^-53, by
 * which its end is rounded, four times that where velocities follow from momenta.
 *
 * A companion that does not arrive gives no number: known is false, the error a NaN.
 *
 * Numbers that enter f (parameters) are moved by the caller, in the companion's own
 * system; likewise, where the method cannot take it, a limit that is not a double
 * exactly: pass its neighbour as the companion's t1.
 *
 * Tests  tests/ode/test_companion.c
 */
#ifndef QDOT_ODE_COMPANION_H
#define QDOT_ODE_COMPANION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/status.h"
#include "ode/integrate.h"

typedef struct {
    bool known;
    double error;           /* as above; NaN where unknown */
    double tol;             /* tol* */
    qdot_ode_result result; /* of the companion: its cost, why it did not arrive */
} qdot_companion_estimate;

typedef struct qdot_companion qdot_companion;

/* What is stated of a number, by its largest distance from those of the companions and by theirs
 * from each other (0: there is one companion),
 *
 *     bound = 5/4 apart + own
 *
 * a bound in 99 cases of 100: where the method's error rules, companions are off by a small part of
 * `apart`, and agree; where they are off by more, as rounding has it, `own` shows it. */
double qdot_companion_bound(double apart, double own);
/* The same of x, which is theirs [count] by the companions, 1 or 2: what the second one is away
 * counts by its share. NaN where one has no value. */
double qdot_companion_bound_of(double x, size_t count, const double *theirs, double share);

typedef struct {
    const qdot_ode_system *system;  /* for the companion alone if `threaded`; borrowed
                                       until _finish */
    const qdot_ode_system *twin;    /* of the second companion; NULL: none; likewise */
    const qdot_ode_method *method;  /* of the run */
    double tol, t0, t1;             /* of the run */
    double t1_low;                  /* t1 beyond itself (integrate.h) */
    const double *y0;               /* [n] borrowed during _start */
    const double *carry;            /* [n] the start beyond y0; NULL: nothing; likewise */
    bool leading;                   /* of the run (integrate.h) */
    double t0_low;                  /* likewise */
    bool threaded; /* run them on threads of their own beside the caller; where none can
                      be had, or false, they run within _finish */
} qdot_companion_request;

/* Begin. The moved start of a system that projects is projected. Errors: QDOT_ENOMEM,
 * those of projection. */
QDOT_MUST_CHECK qdot_status qdot_companion_start(const qdot_companion_request *request,
                                                 qdot_companion **out);

/* The difference at one time may be small by chance, too. So a companion by Taylor series
 * looks at some times of its latter half, in the order of the run, and the error becomes
 *
 *     max(error at the end, median of the errors at those times)
 *
 * once the run has shown its states there, but not more than 30 times that at the end: where
 * errors die out, as in stiff scenes, the last step may leave far less than those between.
 * *count is 0 for other methods. */
const double *qdot_companion_times(const qdot_companion *c, size_t *count);

/* The state y [n] of the run at time k of those; copied. */
void qdot_companion_show(qdot_companion *c, size_t k, const double *y);

/* The most steps that a companion may take beside a run of so many by that method,
 *
 *     r steps + min(200000, 2 s/c),   r = 20; beside a stiff method 100, whose steps no fast motion
 *                                     bounds,
 *
 * c being what a step costs (by the series' model, else n^3 ns). One that wants more does not
 * arrive: it has met what the run has stepped over. The second term is for a scene at rest, which
 * one step may cross, while one moved by a rounding swings for all of the time. */
uint64_t qdot_companion_patience(const qdot_ode_system *system, const qdot_ode_method *method,
                                 uint64_t steps);

/* The run itself took so many steps: the companions get that much patience. */
void qdot_companion_limit(qdot_companion *c, uint64_t steps);

/* By how many doubles the second companion starts away: a walk of so many steps, from 1 to
 * QDOT_COMPANION_FAR. */
double qdot_companion_far(uint64_t steps);
#define QDOT_COMPANION_FAR 3.0

/* What a run of so many steps may err by in any case. */
double qdot_companion_floor(uint64_t steps);

/* The run itself has ended at t_end with y [n]: wait for the companion (that of a run
 * which ended before t1 starts again, to t_end), compare, and free it.
 *   difference  [n] out, may be NULL; NaN where unknown
 * Never fails: what goes wrong makes the error unknown, result.reason says why. */
void qdot_companion_finish(qdot_companion *c, double t_end, const double *y,
                           double *difference, qdot_companion_estimate *out);

/* The most steps of a companion by Taylor series beside a stiff method, which steps over what
 * is fast: where it gets stuck there the method's partner takes over. */
#define QDOT_COMPANION_EXPLICIT 100000

/* Orders more that a companion by Taylor series takes (qdot_ode_options.order_more). */
#define QDOT_COMPANION_ORDERS 3

/* The method of a companion, and its tolerance tol*. */
const qdot_ode_method *qdot_companion_method(const qdot_ode_system *system,
                                             const qdot_ode_method *method);
double qdot_companion_tolerance(const qdot_ode_system *system,
                                const qdot_ode_method *method, double tol);

/* By how much a companion starts away from y in component i, where it is of a run whose first
 * orders are sums of two doubles: by so many times the least. */
double qdot_companion_aside(double tol, double y, size_t i, size_t number, double by);
#define QDOT_COMPANION_AIMS 0.0625

/* Where companion 0 or 1 starts in component i: so many doubles beyond y, a whole number;
 * of a zero 2^-53. */
double qdot_companion_moved(double y, size_t i, size_t number, double by);

#endif
