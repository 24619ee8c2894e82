/* powers.h -- an expression as a function of the roots in it: b^p of sums b, p a fraction, with symbols in their place.
 *
 * Tests  tests/normal/solve/test_simultaneous.c, tests/normal/solve/test_solve.c
 */
#ifndef QDOT_NORMAL_POWERS_H
#define QDOT_NORMAL_POWERS_H

#include "normal/field/facts.h"

enum { QDOT_POWERS_MOST = 3 };

/* The first two are set by the caller; the others 0 before the first replacement. */
typedef struct {
    size_t unknowns;
    const qdot_expr *unknown; /* [unknowns] powers without any of these are left as they are */
    uint32_t n;               /* above QDOT_POWERS_MOST: there are more */
    qdot_expr power[QDOT_POWERS_MOST], base[QDOT_POWERS_MOST], exponent[QDOT_POWERS_MOST];
    qdot_expr symbol[QDOT_POWERS_MOST];
} qdot_powers;

/* The expression e with symbols in place of its powers, which are appended to p. Nil: the pool failed. */
qdot_expr qdot_powers_replace(qdot_pool *pool, qdot_powers *p, qdot_expr e);

/* The k-th power b^p is v: *equation, b - v^(1/p), and *condition (conditions.h), under which v is a value of b^p. False,
 * and nothing is set: p has an odd denominator. */
bool qdot_powers_invert(qdot_pool *pool, const qdot_powers *p, uint32_t k, qdot_expr v, const qdot_facts *facts,
                        qdot_expr *equation, qdot_expr *condition);

/* Whether e = a x + b in the n symbols x, with a [n] and b free of them. */
bool qdot_is_linear_in(qdot_pool *pool, qdot_expr e, uint32_t n, const qdot_expr *x, qdot_expr *a, qdot_expr *b);

#endif
