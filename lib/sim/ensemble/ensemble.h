/* ensemble.h -- many runs of one scene, with their own starts and parameters, in lanes.
 *
 * The scene is derived and lowered once; the varying parameters are inputs of its tape. Members
 * run eight at a time (ode/batch.h), each with the result that it has alone, to rounding, and with the same bits
 * whatever other members are run with it. The error of a member is the distance of its end state
 * from those of two companions, like those of a run alone (ode/companion.h): under a tighter
 * tolerance, with inputs moved to either side and constants rounded the other way.
 *
 * Tests  tests/sim/ensemble/test_ensemble.c
 */
#ifndef QDOT_SIM_ENSEMBLE_H
#define QDOT_SIM_ENSEMBLE_H

#include <math.h>
#include <stdint.h>

#include "ode/companion.h"
#include "sim/model/equations.h"
#include "sim/run/run.h"
#include "sim/ensemble/steps.h"

enum { QDOT_ENSEMBLE_PASSES = 3 }; /* largest number of passes: the runs, and two companion runs of each */

typedef struct qdot_ensemble qdot_ensemble;

typedef struct {
    qdot_run_status status; /* QDOT_RUN_DONE or QDOT_RUN_FAILED */
    const char *reason;     /* why the run failed; NULL when done; valid until the next qdot_ensemble_run or _free */
    double t;               /* the time at which the member ended */
    uint64_t steps, rejected;
    double error; /* error of the end state, relative to max(1, |value|); NaN: unknown or not requested */
} qdot_ensemble_result;

/* The error of a number x of a member, theirs [companions] those of its companions. An only companion was
 * meant to be one: under a hundredth of the tolerance it errs by a three hundredth of the run, so its distance
 * is not counted more than once, as that of a single run is whose second one was given up. */
static inline double
qdot_ensemble_error_of(double x, size_t companions, const double *theirs)
{
    return companions == 1 ? qdot_companion_bound(fabs(theirs[0] - x), 0)
                           : qdot_companion_bound_of(x, companions, theirs);
}

/* Prepare runs of `request`: its values, limits and tolerance; method "auto" or "taylor".
 * The starts are given to qdot_ensemble_run: q0 and v0 must be NULL.
 *   varied  [n_varied] parameters that each member has its own values of; they may not be
 *           among the request's values
 * Errors: as qdot_run_new before anything is integrated; QDOT_ENOTBUILT: constraints under another
 * treatment than projection, events that stop or change a run, equations that switch, coupled
 * coordinates of a stated Lagrangian or of potentials with velocities without constraints; QDOT_EINVAL: another method, starts given, a parameter given twice. The
 * scene may change afterwards. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_new(qdot_scene *scene,
                                              const qdot_run_request *request,
                                              size_t n_varied, const qdot_expr *varied,
                                              qdot_ensemble **ensemble);
void qdot_ensemble_free(qdot_ensemble *ensemble);

/* Before _run: look at steps, borrowed, and keep states at _places times of the latter half of the way,
 * every other one of qdot_companion_places; all passes run in the caller's thread, and a member of more than
 * most_steps is left. QDOT_ENOTBUILT: an event reads a velocity that follows from a kept momentum. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_follow(qdot_ensemble *ensemble,
                                                 const qdot_ensemble_watching *watching,
                                                 uint64_t most_steps);
/* Before _run: so many companions, 2 if nothing is said. One alone shows the errors of the method, and
 * not enough of rounding. */
void qdot_ensemble_companions(qdot_ensemble *ensemble, size_t companions);

/* Run them.
 *   y           [members x 2n] q, q' at the start; then at the end
 *   parameters  [members x n_varied]
 *   results     [members]
 *   errors      whether companions are run, on a second thread, for `error`
 * If a member fails, or its start breaks the constraints, its result says so; that is no error of
 * the call. Errors: QDOT_EINVAL (a number that is not finite), QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_run(qdot_ensemble *ensemble, size_t members,
                                              double *y, const double *parameters,
                                              bool errors, qdot_ensemble_result *results);

/* After _follow and _run with errors, of pass 0 (the run) ... 2 of a member:
 *
 *   _left     it has to be run alone; there is nothing else then
 *   _state    its state into whole [2 (n + varied)], q, parameters, q', 0, at time number `place`
 *             or, beyond those, at the end; false: it was not reached
 *   _time     of a place, or the end
 *   _event_time  when that occurrence was; NaN: there was none
 *   _event_count  how often, in the run
 *   _sizes    [2n] the largest |y_i| at the starts of steps
 *   _plan     of which such states are, its inputs
 *   _share    by which distances of the second companion count */
bool qdot_ensemble_left(const qdot_ensemble *e, size_t member);
bool qdot_ensemble_state(const qdot_ensemble *e, size_t pass, size_t member, size_t place,
                         double *whole);
double qdot_ensemble_event_time(const qdot_ensemble *e, size_t pass, size_t member, size_t event,
                                size_t k);
size_t qdot_ensemble_event_count(const qdot_ensemble *e, size_t member, size_t event);
size_t qdot_ensemble_places(const qdot_ensemble *e);
double qdot_ensemble_time(const qdot_ensemble *e, size_t place);
const double *qdot_ensemble_sizes(const qdot_ensemble *e, size_t member);
const qdot_plan *qdot_ensemble_plan(const qdot_ensemble *e);

/* The whole way of a pass of a member, if the starts of steps are kept (sim/ensemble/path.h):
 * the number of its points, the end among them, 0 if it did not arrive; point i, as for _state. */
size_t qdot_ensemble_points(const qdot_ensemble *e, size_t pass, size_t member);
void qdot_ensemble_point(const qdot_ensemble *e, size_t pass, size_t member, size_t i, double *t,
                         double *whole);
/* The order of a pass; _tolerance: its tolerance; _limits: the time limits and the requested tolerance. */
int qdot_ensemble_order(const qdot_ensemble *e, size_t pass);
double qdot_ensemble_tolerance(const qdot_ensemble *e, size_t pass);
void qdot_ensemble_limits(const qdot_ensemble *e, double *t0, double *t1, double *tol);

/* Whether the equations of motion depend on the varied parameter number k. */
bool qdot_ensemble_reads(const qdot_ensemble *e, size_t k);

#endif
