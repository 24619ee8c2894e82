/* definite.h -- integrals from a to b, exact.
 *
 *     int_a^b e dx = sum over pieces of F(right end) - F(left end)
 *
 * F an antiderivative (antiderivative.h). The range is split where e has a kink (abs, sign, max, min, if), where e is
 * not defined, and where F is not: there F counts by its limits from either side, and if one of these is infinite
 * the integral diverges. Between these places F is continuous by construction: it is made of functions that are,
 * where no divisor vanishes and no logarithm, root or inverse function comes to the end of its domain; that none
 * does is proved.
 *
 * Ends may be symbols: their order and the signs of divisors must follow from declared domains.
 *
 * Tests  tests/script/integrals/
 */
#ifndef QDOT_INTEGRAL_DEFINITE_H
#define QDOT_INTEGRAL_DEFINITE_H

#include "normal/field/facts.h"

typedef enum {
    QDOT_DEFINITE_FOUND,
    QDOT_DEFINITE_DIVERGES,
    QDOT_DEFINITE_UNDEFINED, /* the integrand is not real in a part of the range */
    QDOT_DEFINITE_NOT_FOUND
} qdot_definite_kind;

typedef struct {
    qdot_definite_kind kind;
    qdot_expr value;
    qdot_expr at; /* DIVERGES, UNDEFINED: where; nil: not known */
    qdot_expr undecided; /* NOT_FOUND: an expression of parameters whose sign must be known; nil: there may be none */
} qdot_definite_answer;

/* Integrate the scalar e over x from lo to hi, scalars free of x. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_definite(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi,
                                          const qdot_facts *facts, qdot_definite_answer *answer);

/* The same; where the value or whether there is one depends on the sign of an expression s of parameters, if(s > 0, A, B).
 * What is not found in one of the cases, or diverges there, stands as an integral. For s = 0 the value is that of B, if B is
 * defined there. */
QDOT_MUST_CHECK qdot_status qdot_definite_by_cases(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi,
                                                   const qdot_facts *facts, qdot_definite_answer *answer);

#endif
