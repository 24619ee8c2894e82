/* history.h -- the answers that %1, %2, ... and % stand for. */
#ifndef QDOT_LANG_HISTORY_H
#define QDOT_LANG_HISTORY_H

#include "base/memory.h"
#include "lang/session/parts.h"

typedef struct qdot_history {
    qdot_vec(qdot_expr) values;  /* the answers: %1 is values.at[0] */
    qdot_vec(qdot_expr) over; /* for each answer a LIST of coordinates that index its entries; nil: none */
    qdot_expr series, series_in; /* the latest series(...) and a LIST of its variables; nil: none */
} qdot_history;

/* Add a value to the history: `%` from now on. over: the LIST of coordinates its entries go by, or
 * nil. */
QDOT_MUST_CHECK qdot_status qdot_session_remember(qdot_session *session, qdot_expr value,
                                                  qdot_expr over);

#endif
