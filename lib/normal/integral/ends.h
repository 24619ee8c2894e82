/* ends.h -- the values of a function at the ends of a range, as limits from inside.
 *
 * Tests  tests/script/integrals/
 */
#ifndef QDOT_INTEGRAL_ENDS_H
#define QDOT_INTEGRAL_ENDS_H

#include "normal/field/facts.h"

typedef enum {
    QDOT_END_VALUE,
    QDOT_END_INFINITE,
    QDOT_END_UNKNOWN
} qdot_end_kind;

typedef struct {
    qdot_end_kind kind;
    qdot_expr value;
    qdot_expr undecided; /* UNKNOWN: an expression of parameters whose sign must be known; nil: there may be none */
} qdot_end;

/* The limit of F as x tends to `at`, which may be QDOT_INFINITY or its negative, from the side: 1 above, -1 below.
 * Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_end_value(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, int side,
                                           const qdot_facts *facts, qdot_end *end);

#endif
