/* stiffness.h -- sees that the steps of an explicit method are bound by stability.
 *
 * Where a motion is damped fast and then goes slowly, an explicit method has to keep its steps below
 * the time of the damping for ever. Then over hundreds of steps every component moves along a
 * parabola,
 *
 *     |y_i(t) - parabola through y_i at both ends and the middle|
 *         <= share (max y_i - min y_i) + noise max(s_i, |y_i|),
 *
 * at seven more places without a pattern, which no motion does that its steps h follow;
 * noise is what these leave of the fast one. A fast force of t leaves as little, and no method can skip it: there
 * h |df/dy| is small, in units of max(s_i, |y_i|), while where stability bounds h it is not. It matters if much work is left (in about nanoseconds;
 * meter.h), where steps that became longer within the window are taken to go on so,
 *
 *     h(n) = h exp(k n),   n = log(1 + k (t1 - t)/h)/k:
 *
 * the run ends, and says so. So does a run by any method that after a million steps would
 * need more than it may take.
 *
 * Tests  tests/ode/test_stiffness.c, tests/script/methods/stiff-told.sh, stiff-auto.lag
 */
#ifndef QDOT_ODE_STIFFNESS_H
#define QDOT_ODE_STIFFNESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ode/run.h"
#include "ode/system.h"

enum { QDOT_ODE_STIFF_PLACES = 10 };

typedef struct {
    double *y;   /* [places x n] sampled states, allocated at first use */
    double t[QDOT_ODE_STIFF_PLACES];
    size_t count; /* number of sampled states */
    int wait;     /* steps until the next sample; 0: no sample yet */
    int windows;  /* windows of steps examined so far; the first have 500 steps, later ones 4000 */
    bool high;    /* all windows have only 500 steps, because the steps are long and of high order */
    uint64_t steps; /* total number of steps in all windows */
} qdot_ode_stiffness;

void qdot_ode_stiffness_clear(qdot_ode_stiffness *s);

/* The end of a step, as the stiffness detector needs it. */
typedef struct {
    const qdot_ode_system *system; /* the system, to test for stiffness; NULL: assume that stability may limit any step */
    size_t n;
    double t, t1;    /* present time, end time of the run */
    const double *y; /* [n] the present state */
    const double *scales; /* [n] scales s_i of the components (scale.h) */
    double noise; /* rounding noise relative to the size of a component */
    double work;   /* work of one step (unit: meter.h) */
    uint64_t most; /* largest number of steps that the run may take */
    bool implicit; /* the method is implicit, so that stability does not limit its steps */
    bool high;     /* steps by Taylor series of high order: a few hundred states on one parabola suffice */
} qdot_ode_stiff_step;

/* Whether the state after the step just taken is one of the few that are sampled. */
bool qdot_ode_stiffness_is_due(qdot_ode_stiffness *s);

/* Then look. QDOT_ELIMIT: steps are bound by stability, and *stiff, or too many are left;
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ode_stiffness_look(qdot_ode_stiffness *s,
                                                    const qdot_ode_stiff_step *at,
                                                    const qdot_ode_options *options, bool *stiff);

#endif
