/* record-times.h -- the times at which a statement reads a run, which say how long the run must be. */
#ifndef QDOT_LANG_RECORD_TIMES_H
#define QDOT_LANG_RECORD_TIMES_H

#include "lang/syntax/record.h"

/* The time of value(E, T), max(E, A..B), ... in the statement from the token `at` on that is farthest from the start
 * of the run; nil: none. */
qdot_expr qdot_record_farthest_time(const qdot_record *r, const qdot_token *at, qdot_expr start);

#endif
