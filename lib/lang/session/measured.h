/* measured.h -- numbers from runs: a symbol represents each in expressions. */
#ifndef QDOT_LANG_MEASURED_H
#define QDOT_LANG_MEASURED_H

#include "base/memory.h"
#include "lang/session/origin.h"
#include "lang/session/parts.h"

/* A number from a run; a FORMAL symbol represents it in expressions. */
typedef struct {
    qdot_expr symbol;
    double value, error; /* value and its error; error NaN: unknown */
    int digits;          /* digits of the number, if the run was made with the option `digits`; else 0 */
    qdot_expr exact; /* if it has many digits: the exact rational; otherwise nil, or the exact value that `set` uses */
    bool plain;          /* no digits were requested: with --json it is a number, not a string */
    qdot_origin origin;
} qdot_measured;

typedef struct qdot_measured_list {
    qdot_vec(qdot_measured);
} qdot_measured_list;

/* A new symbol for a result of a run; nil on failure, which the pool keeps. */
qdot_expr qdot_measured_new(qdot_session *session, double value, double error);
qdot_expr qdot_measured_add(qdot_session *session, qdot_measured m);
/* The number of a run for which the symbol stands; NULL: it is another. Valid until the next number is added. */
const qdot_measured *qdot_measured_find(const qdot_session *session, qdot_expr symbol);
/* Whether e contains a number from a run. */
bool qdot_measured_occurs(qdot_session *session, qdot_expr e);
/* The expression e with the results of runs in it replaced by exact rationals. */
qdot_expr qdot_measured_as_rationals(qdot_session *session, qdot_expr e);
/* A double as the rational number that it equals exactly. */
qdot_expr qdot_measured_rational(qdot_pool *pool, double x);

#endif
