/* event-time.h -- times of the events of a run. */
#ifndef QDOT_LANG_EVENT_TIME_H
#define QDOT_LANG_EVENT_TIME_H

#include "lang/session/parts.h"
#include "sim/course/report.h"

/* Whether the scene, or that run (NULL: the latest), has an event of that name. */
bool qdot_event_is(const qdot_session *session, const char *run, const char *name);

/* The number of digits to which the time of an event is known; 0 for a double. */
int qdot_event_digits(const qdot_run *run, const qdot_run_occurrence *o);

/* Find the time of occurrence k of the event, counted from 1; for k = 0 a list of all. */
QDOT_MUST_CHECK qdot_status qdot_event_time(qdot_session *session, const char *run,
                                            const char *name, int64_t k, qdot_expr *value);

#endif
