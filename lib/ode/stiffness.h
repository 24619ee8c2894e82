/* stiffness.h -- sees that the steps of an explicit method are bound by stability.
 *
 * Where a motion is damped fast and then goes slowly, an explicit method has to keep its steps below
 * the time of the damping for ever. Then over thousands of steps every component moves along a
 * straight line,
 *
 *     |y_i(t) - line through y_i at both ends| <= share |change of y_i| + tol max(1, |y_i|),
 *
 * at eight places without a pattern between the ends, which no motion does that its steps follow.
 * It matters if much work is left (in about nanoseconds; meter.h): the run ends, and says so.
 *
 * Tests  tests/ode/test_stiffness.c, tests/script/stiff-told.sh, stiff-auto.lag
 */
#ifndef QDOT_ODE_STIFFNESS_H
#define QDOT_ODE_STIFFNESS_H

#include <stdbool.h>
#include <stddef.h>

#include "ode/run.h"

enum { QDOT_ODE_STIFF_PLACES = 10 };

typedef struct {
    double *y;   /* [places x n] states, allocated when they are needed */
    double t[QDOT_ODE_STIFF_PLACES];
    size_t count; /* of them */
    int wait;     /* steps until the next */
} qdot_ode_stiffness;

void qdot_ode_stiffness_clear(qdot_ode_stiffness *s);

/* Where a step ended. */
typedef struct {
    size_t n;
    double t, t1;    /* now, and the end of the run */
    const double *y; /* [n] */
    double tol;
    double work; /* of a step */
} qdot_ode_stiff_step;

/* Look after a step. QDOT_ELIMIT: steps are bound by stability, and *stiff; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_ode_stiffness_look(qdot_ode_stiffness *s,
                                                    const qdot_ode_stiff_step *at,
                                                    const qdot_ode_options *options, bool *stiff);

#endif
