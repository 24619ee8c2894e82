/* start-kind.h -- in what the start of runs is given: velocities, momenta or speeds. */
#ifndef QDOT_LANG_START_KIND_H
#define QDOT_LANG_START_KIND_H

#include "lang/session/parts.h"

/* Whether the start gives a momentum p[q]: the velocities follow from it when a run begins. Of q' and p[q] the latest counts. */
bool qdot_session_starts_by_momenta(const qdot_session *session);
/* Whether the start gives a speed (lang/session/speeds.h): all velocities follow from speeds when a run begins, and a start
 * gives either. */
bool qdot_session_starts_by_speeds(const qdot_session *session);
/* Whether the start gives a velocity or a momentum. */
bool qdot_session_starts_by_velocities(const qdot_session *session);
/* QDOT_EINVAL if `symbol` is a speed and the start gives velocities, or the other way round: one would be ignored. */
QDOT_MUST_CHECK qdot_status qdot_session_goes_with_start(const qdot_session *session, qdot_expr symbol);
/* Set the value of every speed with which runs start to what it is at the start's coordinates and velocities, in place of these. */
QDOT_MUST_CHECK qdot_status qdot_session_start_by_speeds(qdot_session *session);
/* The start gives no value to a speed. */
void qdot_session_start_forget_speeds(qdot_session *session);

#endif
