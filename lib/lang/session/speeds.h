/* speeds.h -- the speeds (quasi-velocities) of a session, names declared by `speed u = E`. */
#ifndef QDOT_LANG_SPEEDS_H
#define QDOT_LANG_SPEEDS_H

#include "lang/session/parts.h"
#include "mech/dynamics/speeds.h"

bool qdot_session_has_speeds(const qdot_session *session);
/* Whether `symbol` is that of a speed. */
bool qdot_session_is_speed(const qdot_session *session, qdot_expr symbol);
/* All speeds in order of declaration; free symbol and value, which are one array that begins at symbol. */
QDOT_MUST_CHECK qdot_status qdot_session_speeds(const qdot_session *session, qdot_speeds *speeds);
/* e with every speed u, and u', replaced by E and dE/dt. Nil on failure: the pool keeps it. */
qdot_expr qdot_session_speeds_replaced(const qdot_session *session, qdot_expr e);
/* Whether speeds stand in e [n] together with velocities or accelerations of coordinates. */
bool qdot_session_speeds_meet(const qdot_session *session, uint32_t n, const qdot_expr *e);

/* eom where speeds are declared: a LIST of the equations of the speeds and the kinematic ones q' = ...; for_one: that of a
 * speed or a coordinate, nil: all. */
QDOT_MUST_CHECK qdot_status qdot_session_speeds_eom(qdot_session *session, qdot_expr for_one, qdot_expr *value);
/* dE/dt along the motion in q, u, t, simplified, of a scalar E in these. Nil on failure: the pool keeps it. */
qdot_expr qdot_session_speeds_rate(qdot_session *session, qdot_expr e);
/* Whether e is written in speeds, and these suffice: it holds one, and no velocity of a coordinate. */
bool qdot_session_in_speeds(qdot_session *session, qdot_expr e);
/* By what the members of that LIST are indexed: the LIST of speeds and coordinates. */
QDOT_MUST_CHECK qdot_status qdot_session_speeds_members(qdot_session *session, qdot_expr *over);

#endif
