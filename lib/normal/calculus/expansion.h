/* expansion.h -- expansions e = c0 w^q0 + c1 w^q1 + ... as w > 0 becomes small, with rational exponents q0 < q1 < ...
 *
 * The coefficients may hold a variable x of which w is an exponential: they change more slowly than any power of w. A
 * coefficient is dropped where it is proved to be 0; that a leading one is not 0 is proved, too, or nothing is said.
 *
 * Source  Gruntz, "On computing limits in a symbolic manipulation system", ETH Zurich 1996, chapter 3
 * Tests   tests/normal/calculus/test_limit.c, tests/script/integral/limit.lag
 */
#ifndef QDOT_NORMAL_EXPANSION_H
#define QDOT_NORMAL_EXPANSION_H

#include "normal/field/facts.h"

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr w, log_w; /* the small symbol, and what its logarithm is without it */
    bool undefined;     /* a root or a logarithm of what is proved to be negative was met */
} qdot_expansion;

/* The first term of e: *coefficient w^(numerator/denominator). QDOT_EFAILED: it was not found. Others: QDOT_ENOMEM,
 * QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_expansion_lead(qdot_expansion *x, qdot_expr e, qdot_expr *coefficient, int64_t *numerator,
                                                int64_t *denominator);
/* 1, -1 or 0 where the sign of a constant or of an expression in symbols is proved; 2: it is not known. */
int qdot_proved_sign(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
