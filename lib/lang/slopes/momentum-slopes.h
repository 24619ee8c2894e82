/* momentum-slopes.h -- how velocities at the start of a run depend on an unknown, where momenta are given.
 *
 *     sum_j dP_i/dq'_j dq'_j/du = dp_i/du - dP_i/dq dq/du - sum_{j not in S} dP_i/dq'_j dq'_j/du - dP_i/du
 *
 * for the coordinates i, j of S, those that start with a momentum p_i = P_i(q, q', t), P = dL/dq'; all at the start.
 *
 * Tests  tests/script/runs/start-momenta-unknown.lag
 */
#ifndef QDOT_LANG_MOMENTUM_SLOPES_H
#define QDOT_LANG_MOMENTUM_SLOPES_H

#include "lang/session/conditions.h"
#include "lang/session/parts.h"

typedef struct {
    const qdot_conditions *of; /* the run */
    qdot_expr unknown;         /* a parameter, q, q' or p[q] */
    const qdot_expr *values;   /* [of->symbols.n] values of parameters in terms of the unknown; NULL: it is no parameter */
} qdot_momentum_slopes_of;

/* Complete start [2n], dq/du and dq'/du, by the velocities that momenta determine; without such momenta it stays. In the session
 * the unknown, if it is a parameter, is set to itself. Errors: QDOT_ENOTBUILT, the scene has constraints. */
QDOT_MUST_CHECK qdot_status qdot_momentum_slopes(qdot_session *session, const qdot_momentum_slopes_of *x, qdot_expr *start);

#endif
