/* timing.h -- the report of a statement's CPU time, which `timing on` turns on. */
#ifndef QDOT_LANG_TIMING_H
#define QDOT_LANG_TIMING_H

#include <time.h>

#include "lang/session/parts.h"

/* Answer with the CPU time since `since`, as of clock(), and the size of the pool of expressions. */
void qdot_timing_report(qdot_session *session, clock_t since);

#endif
