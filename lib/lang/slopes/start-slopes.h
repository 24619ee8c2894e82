/* start-slopes.h -- how velocities at the start of a run depend on an unknown, where momenta or speeds are given.
 *
 * Let functions P_i(q, q', t), linear in q' or not, have given values p_i at the start: momenta dL/dq', or speeds beside 0 of each
 * constraint as one of velocities. They determine the velocities of the coordinates j of S,
 *
 *     sum_j dP_i/dq'_j dq'_j/du = dp_i/du - dP_i/dq dq/du - sum_{j not in S} dP_i/dq'_j dq'_j/du - dP_i/du.
 *
 * With momenta S are the coordinates whose momentum is given, with speeds all.
 *
 * Tests  tests/script/runs/start-momenta-unknown.lag, start-speeds-unknown.lag
 */
#ifndef QDOT_LANG_START_SLOPES_H
#define QDOT_LANG_START_SLOPES_H

#include "lang/session/conditions.h"
#include "lang/session/parts.h"

typedef struct {
    const qdot_conditions *of; /* the run */
    qdot_expr unknown;         /* a parameter, q, q', p[q] or a speed */
    const qdot_expr *values;   /* [of->symbols.n] values of parameters in terms of the unknown; NULL: it is no parameter */
} qdot_start_slopes_of;

/* Complete start [2n], dq/du and dq'/du, by the velocities that momenta or speeds determine; without such ones it stays. In the
 * session the unknown, if it is a parameter, is set to itself. Errors: QDOT_ENOTBUILT, momenta in a scene with constraints. */
QDOT_MUST_CHECK qdot_status qdot_start_slopes(qdot_session *session, const qdot_start_slopes_of *x, qdot_expr *start);

#endif
