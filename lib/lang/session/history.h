/* history.h -- the answers that %1, %2, ... and % stand for. */
#ifndef QDOT_LANG_HISTORY_H
#define QDOT_LANG_HISTORY_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* The latest linear motion, x' = A x + B u, y = C x + D u; every expression nil where there is none. */
typedef struct {
    qdot_expr A, B, C, D;               /* matrices; B, C, D nil without inputs, outputs */
    qdot_expr states, inputs, outputs;  /* LISTs */
    qdot_expr symbols, values, change;  /* LISTs of all that moves with state and inputs, and its values at the state; a
                                         * LIST of their changes, by rows */
    uint64_t version;                   /* of the scene */
    uint64_t numbers;                   /* 1: computed with the values of `set` */
} qdot_linear;

typedef struct qdot_history {
    qdot_vec(qdot_expr) values;  /* the answers: %1 is values.at[0] */
    qdot_vec(qdot_expr) over; /* for each answer a LIST of coordinates that index its entries; nil: none */
    qdot_expr series, series_in; /* the latest series(...) and a LIST of its variables; nil: none */
    qdot_expr steady_in; /* the rate for which the latest `steady in` solved; nil: the latest `steady` had none */
    qdot_expr modes_at; /* the place of the latest `modes at`, a LIST; nil: the latest `modes` had none */
    uint64_t modes_version; /* of the scene then */
    qdot_linear linear;
} qdot_history;

/* Add a value to the history: `%` from now on. over: the LIST of coordinates its entries go by, or
 * nil. */
QDOT_MUST_CHECK qdot_status qdot_session_remember(qdot_session *session, qdot_expr value,
                                                  qdot_expr over);

#endif
