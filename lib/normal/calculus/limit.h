/* limit.h -- limits of expressions at a place or at infinity.
 *
 * x = a + 1/X or a - 1/X turns every limit into one of X to infinity. There the most rapidly varying subexpressions,
 * exponentials of one comparability class, are powers of one small w; the first term c w^q of the expansion in w decides:
 * 0 for q > 0, infinite for q < 0, the limit of c for q = 0, in which only slower ones are left. Nothing is concluded from
 * numbers: which of two grows faster, the sign of what is infinite and that a coefficient is not 0 are each proved.
 * Parameters are generic, with the signs that were declared.
 *
 * abs, sign, min, max, if are decided by the sign of their arguments near the place, floor and mod by the side from which
 * these come. Where an argument of sine, cosine or floor grows without bound, that part is only known to be bounded: the
 * limit is found if its coefficient tends to 0, or to another value while the rest is infinite.
 *
 * Source  Gruntz, "On computing limits in a symbolic manipulation system", ETH Zurich 1996
 * Tests   tests/normal/calculus/test_limit.c, tests/script/integral/limit.lag
 */
#ifndef QDOT_NORMAL_LIMIT_H
#define QDOT_NORMAL_LIMIT_H

#include "normal/field/facts.h"

typedef enum {
    QDOT_LIMIT_NOT_FOUND,
    QDOT_LIMIT_VALUE,     /* `value` is the limit */
    QDOT_LIMIT_INFINITE,  /* `value` is QDOT_INFINITY or minus it */
    QDOT_LIMIT_UNDEFINED, /* e has no real value on that side of the place */
    QDOT_LIMIT_NONE       /* from the left `left`, from the right `right`, which differ; each may be infinite */
} qdot_limit_kind;

typedef struct {
    qdot_limit_kind kind;
    qdot_expr value, left, right;
    qdot_expr undecided; /* NOT_FOUND: an expression of parameters whose sign must be known; nil: there may be none */
} qdot_limit_answer;

/* The limit of the scalar e as the symbol x tends to a, which may be QDOT_INFINITY or minus it. side: 1 from the right,
 * -1 from the left, 0 from both; of a place at which e is defined on one side only, from that. Errors: QDOT_ENOMEM,
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_limit(qdot_pool *pool, const qdot_facts *facts, qdot_expr e, qdot_expr x, qdot_expr a,
                                       int side, qdot_limit_answer *answer);

#endif
