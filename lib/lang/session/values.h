/* values.h -- the values that `set`, `start` and `scale` have given. */
#ifndef QDOT_LANG_VALUES_H
#define QDOT_LANG_VALUES_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* A value set by `start RUN`, and how far that run's two companion runs ended from it (qdot_run_end_apart). */
typedef struct {
    qdot_expr symbol, value;
    double apart[2];
} qdot_start_error;

typedef struct qdot_values {
    qdot_vec(qdot_expr) set_symbols, set_values; /* parameters and their latest values by `set` */
    qdot_vec(qdot_expr) start_symbols, start_values; /* coordinates q, velocities q', momenta p[q] or speeds, and their start values */
    qdot_vec(qdot_expr) start_open; /* start values that constraints may change while `find` varies others */
    qdot_vec(qdot_expr) scale_symbols, scale_values; /* q, q' or t, and their scales by `scale` */
    qdot_vec(qdot_start_error) start_errors; /* errors of start values from `start RUN`; each valid while its value is unchanged */
    bool start_exactly; /* the latest `start` had the word `exactly` */
} qdot_values;

/* From now on the symbol (a parameter, a momentum) or undefined function (applied to formal symbols
 * that stand in `value`) has this value for numbers. *status: QDOT_ENOMEM; unchanged if all is well. */
void qdot_session_set(qdot_session *session, qdot_expr symbol, qdot_expr value,
                      qdot_status *status);
/* The value that `set` gave to a symbol, or `start` to q, q', p[q] or a speed, as it was given; nil: none. */
qdot_expr qdot_session_value_set(const qdot_session *session, qdot_expr symbol);
qdot_expr qdot_session_value_started(const qdot_session *session, qdot_expr symbol);
/* Set the value of q or q' with which runs start from now on. */
QDOT_MUST_CHECK qdot_status qdot_session_start(qdot_session *session, qdot_expr jet,
                                               qdot_expr value);
/* The start gives no value to the symbol. */
void qdot_session_start_forget(qdot_session *session, qdot_expr symbol);
/* Whether the symbol is one that `start` gives a value: q, q', p[q]. */
bool qdot_session_is_start(const qdot_pool *pool, qdot_expr symbol);
/* Set a value as `set` or `start` does, depending on the kind of symbol. */
QDOT_MUST_CHECK qdot_status qdot_session_put(qdot_session *session, qdot_expr symbol,
                                             qdot_expr value);

#endif
