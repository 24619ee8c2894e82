/* constant.h -- is a constant zero? A root bound decides it for real algebraic numbers.
 *
 * For E built of rationals by + - * /, roots, absolute values and the circular functions
 * of rational multiples of pi, E = U/L with algebraic integers U and L of one field of
 * degree D, whose conjugates are at most u and l. So
 *
 *     E = 0   or   |E| >= 1/(u^(D - 1) l),
 *
 * and an enclosure that is smaller proves E = 0. By rules, node for node:
 *
 *     p/q: |p|, q;   a + b: u v' + u' v, l l';   a b: u u', l l';   1/a: l, u;
 *     a^(1/k): (u l^(k-1))^(1/k), l;   2 cos(2 pi p/q): 2, 1;
 *
 * D is the product of the k of all different roots and the degree of the real subfield
 * of the roots of unity that occur.
 *
 * Source  Burnikel, Funke, Mehlhorn, Schirra, Schmitt, "A separation bound for real
 *         algebraic expressions", Algorithmica 55 (2009) 14.
 * Tests   tests/normal/prove/test_decide.c
 */
#ifndef QDOT_NORMAL_CONSTANT_H
#define QDOT_NORMAL_CONSTANT_H

#include "expr/id.h"

/* The sign of a constant, as far as it is proved. */
typedef enum {
    QDOT_CONSTANT_UNKNOWN, /* undefined, not algebraic, or decided only with more digits than allowed */
    QDOT_CONSTANT_ZERO,
    QDOT_CONSTANT_POSITIVE,
    QDOT_CONSTANT_NEGATIVE
} qdot_constant_sign;

/* Of e, a scalar without symbols (pi may occur). A sign is found by enclosures whatever
 * the functions in e; zero only for algebraic numbers. Errors: QDOT_ENOMEM,
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_constant_decide(qdot_pool *pool, qdot_expr e,
                                                 qdot_constant_sign *sign);


#endif
