/* steps.h -- what is seen of an ensemble's members while they are integrated in lanes: their
 * states at some times, the first occurrences of events, bounds that come near, sizes.
 *
 * A lane's series is the solution within its step. States at given times are read from it; events are
 * found on it as along a run (sim/watch/watch.h), in a watch for each lane; a bound of a coordinate
 * stays far as long as |x_0 - bound| > sum_k |x_k s^k|.
 *
 * Tests  tests/sim/ensemble/test_ensemble-steps.c, tests/script/sweeps/sweep-lanes.sh
 */
#ifndef QDOT_SIM_ENSEMBLE_STEPS_H
#define QDOT_SIM_ENSEMBLE_STEPS_H

#include "ode/batch.h"
#include "sim/model/equations.h"

/* The first `count` occurrences are told of g = 0, crossed that way (1 rising, -1 falling, 0
 * either). */
typedef struct {
    qdot_expr function;
    int way;
    size_t count;
} qdot_ensemble_event;
typedef struct {
    size_t coordinate;
    double bound;
} qdot_ensemble_bound;

/* What is looked at in every step. A member to which a bound comes near, or in which an event only
 * touches 0, is left: it has to be run alone. */
typedef struct {
    size_t n_events, n_bounds;
    const qdot_ensemble_event *events;
    const qdot_ensemble_bound *bounds;
    bool leave; /* a member ends as soon as the requested number of event occurrences is found */
    bool keep;  /* store the start of every step (sim/ensemble/path.h) */
} qdot_ensemble_watching;

typedef struct qdot_ensemble_steps qdot_ensemble_steps; /* one object for each pass */

/* For members of that plan, parameters that vary being its states; all borrowed. times [n_times]: in
 * the direction of the run. Errors: as qdot_watch_new. */
typedef struct {
    const qdot_plan *plan;
    const qdot_ensemble_watching *watching;
    size_t n_times;
    const double *times;
    double tol;
    bool shaken, moved, backward; /* constants are perturbed; starts are those of companion runs; time runs backward */
} qdot_ensemble_steps_of;
QDOT_MUST_CHECK qdot_status qdot_ensemble_steps_new(const qdot_ensemble_steps_of *of,
                                                    qdot_ensemble_steps **steps);
void qdot_ensemble_steps_free(qdot_ensemble_steps *s);

/* Call before running a pass of `members` ensemble members. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ensemble_steps_begin(qdot_ensemble_steps *s, size_t members);
/* Set the callbacks of an ensemble's system so that each of its steps is inspected. */
void qdot_ensemble_steps_look(qdot_ensemble_steps *s, qdot_ode_batch *system);

/* For one member: the starts of its steps, if stored: t and the state, [1 + 2n + varied] each. */
typedef struct {
    size_t n, capacity; /* how many numbers are stored, allocated */
    double *at;
} qdot_ensemble_starts;
const qdot_ensemble_starts *qdot_ensemble_steps_starts(const qdot_ensemble_steps *s, size_t member);

/* Of a member: how many of the times it has passed, and its state there [2n + varied], as the batch
 * has it; the time of occurrence k of an event, a NaN: there is none; how many
 * there were; the largest |y_i| [2n] at the
 * ends of its steps; whether a bound came near, or an event only touched 0. */
size_t qdot_ensemble_steps_passed(const qdot_ensemble_steps *s, size_t member);
double *qdot_ensemble_steps_state(const qdot_ensemble_steps *s, size_t member, size_t time);
double qdot_ensemble_steps_event(const qdot_ensemble_steps *s, size_t member, size_t event,
                                 size_t k);
size_t qdot_ensemble_steps_count(const qdot_ensemble_steps *s, size_t member, size_t event);
const double *qdot_ensemble_steps_sizes(const qdot_ensemble_steps *s, size_t member);
bool qdot_ensemble_steps_doubtful(const qdot_ensemble_steps *s, size_t member);

#endif
