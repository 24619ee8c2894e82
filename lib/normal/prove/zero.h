/* zero.h -- is a polynomial of a field zero as a function of the symbols?
 *
 * The normal form of field.h knows r^k = b for a root, not which of the roots r is, nor
 * relations between the roots. So p can be zero and its normal form not. Four steps:
 *
 *   constants  the coefficients over the generators that are not constant are algebraic
 *              numbers; each is decided by its bound (constant.h).
 *   norms      p = P + Q R, R a power of an outermost root r or an absolute value,
 *              R^k = B without r. Then P^k = (-Q)^k B, proved in turn, gives p = 0
 *                - for odd k, all being real;
 *                - for even k where P Q <= 0, from the signs of generators (declared
 *                  domains, angles between multiples of pi, what is known positive);
 *                - for even k where all is analytic on a connected domain and
 *                  P - Q R is not 0 at one point: a product of analytic functions is 0
 *                  only if one of them is.
 *
 *   logarithms the coefficients are sums of k log A with integers k: 0 if the product of
 *              all A^k is 1; m times such a sum and a rest without logarithms: 0 if the
 *              product is exp(-rest/m).
 *   angles     the coefficients are sums of k atan u, k asin u, ... and q pi: 0 if the product
 *              of complex numbers of these arguments is real, and the sum not beyond pi.
 *
 * Tests   tests/normal/prove/test_decide.c
 */
#ifndef QDOT_NORMAL_ZERO_H
#define QDOT_NORMAL_ZERO_H

#include "normal/field/field.h"
#include "normal/field/ideal.h"

typedef struct {
    qdot_field *f;
    const qdot_ideal *ideal; /* relations between the generators; NULL: none */
    size_t n_positive;
    const qdot_expr *positive; /* [n_positive] expressions in the field that are > 0 */
    bool sure;                 /* the expressions in `positive` are > 0 on the whole declared domain */
    uint8_t *sign;             /* [f->n] signs of the generators */
    /* Proves that two prepared sides, simpler than p, are equal; set by the caller. */
    qdot_status (*prove)(qdot_pool *pool, qdot_expr left, qdot_expr right, size_t n_positive,
                         const qdot_expr *positive, bool sure, bool *equal);
} qdot_zero;

/* Determine the signs of the generators. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_zero_begin(qdot_zero *z, qdot_field *f,
                                            const qdot_ideal *ideal, size_t n_positive,
                                            const qdot_expr *positive, bool sure);
void qdot_zero_end(qdot_zero *z);

/* Whether p is proved to be zero. Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_zero_prove(qdot_zero *z, const fmpz_mpoly_t p,
                                            bool *zero);

/* Try to prove p = 0 by relations of logarithms (logarithm.c). */
QDOT_MUST_CHECK qdot_status qdot_zero_logarithms(qdot_zero *z, const fmpz_mpoly_t p,
                                                 bool *zero);

/* Try to prove p = 0 by relations of angles (angle-sum.c). */
QDOT_MUST_CHECK qdot_status qdot_zero_angles(qdot_zero *z, const fmpz_mpoly_t p,
                                             bool *zero);

/* What is known of the sign of p (range.c), as bits QDOT_GE0 ... */
uint8_t qdot_zero_sign(qdot_zero *z, const fmpz_mpoly_t p);

/* The signs of a generator from declared domains (range.c). */
uint8_t qdot_range_sign(qdot_pool *pool, const qdot_gen *gen);

#endif
