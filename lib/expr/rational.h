/* rational.h -- inline arithmetic of small rationals; large ones by FLINT.
 *
 *     y = x,   y = a b,   y = a + b,   y = y + a b,   gcd(a, b),   sign x,   a <=> b
 *
 * as fmpq_set, fmpq_mul, fmpq_add, fmpq_addmul, fmpq_gcd, fmpq_sgn, fmpq_cmp, fmpq_equal: canonical in,
 * canonical out; y may be a or b. Constructors mostly need products with 1 and -1,
 * and would spend most of their time in calls of a library.
 *
 * Tests  tests/expr/test_rational.c
 */
#ifndef QDOT_EXPR_RATIONAL_H
#define QDOT_EXPR_RATIONAL_H

#include <stdbool.h>
#include <stdint.h>

#include <flint/fmpq.h>

#include "num/integer.h"

/* Numbers up to 2^30 are small: products of two, and their sums, have less than 62 bits and are small integers of FLINT, too,
 * where its words have 64 bits. */
#define QDOT_SMALL (INT64_C(1) << 30)

static inline bool
qdot_rational_is_small(const fmpq *x)
{
    return (uint64_t)(x->num + QDOT_SMALL) <= 2 * QDOT_SMALL &&
           (uint64_t)x->den <= QDOT_SMALL;
}

/* Set the rational number y = n/d, d > 0, both less than 2^62. */
static inline void
qdot_rational_make(fmpq *y, int64_t n, int64_t d)
{
    uint64_t a = n < 0 ? -(uint64_t)n : (uint64_t)n, b = (uint64_t)d;

    if (b != 1) {
        while (a != 0) {
            uint64_t c = b % a;

            b = a;
            a = c;
        }
        n /= (int64_t)b;
        d /= (int64_t)b;
    }
#if FLINT_BITS == 64
    _fmpz_demote(&y->num);
    _fmpz_demote(&y->den);
    y->num = n;
    y->den = d;
#else
    qdot_integer_set(&y->num, n);
    qdot_integer_set(&y->den, d);
#endif
}

static inline void
qdot_rational_set(fmpq *y, const fmpq *x)
{
    if (COEFF_IS_MPZ(x->num) || COEFF_IS_MPZ(x->den)) {
        fmpq_set(y, x);
        return;
    }
    _fmpz_demote(&y->num);
    _fmpz_demote(&y->den);
    *y = *x;
}

static inline void
qdot_rational_mul(fmpq *y, const fmpq *a, const fmpq *b)
{
    if (qdot_rational_is_small(a) && qdot_rational_is_small(b))
        qdot_rational_make(y, (int64_t)a->num * b->num, (int64_t)a->den * b->den);
    else
        fmpq_mul(y, a, b);
}

static inline void
qdot_rational_add(fmpq *y, const fmpq *a, const fmpq *b)
{
    if (qdot_rational_is_small(a) && qdot_rational_is_small(b))
        qdot_rational_make(y, (int64_t)a->num * b->den + (int64_t)b->num * a->den, (int64_t)a->den * b->den);
    else
        fmpq_add(y, a, b);
}

static inline void
qdot_rational_addmul(fmpq *y, const fmpq *a, const fmpq *b)
{
    fmpq product = {0, 1};

    qdot_rational_mul(&product, a, b);
    qdot_rational_add(y, y, &product);
    _fmpz_demote(&product.num);
    _fmpz_demote(&product.den);
}

/* Find the largest y of which a and b are both integer multiples; 0 for two zeros. */
static inline void
qdot_rational_gcd(fmpq *y, const fmpq *a, const fmpq *b)
{
    int64_t u, v;

    if (!qdot_rational_is_small(a) || !qdot_rational_is_small(b)) {
        fmpq_gcd(y, a, b);
        return;
    }
    u = (int64_t)(a->num < 0 ? -a->num : a->num) * b->den;
    v = (int64_t)(b->num < 0 ? -b->num : b->num) * a->den;
    while (v != 0) {
        int64_t rest = u % v;

        u = v;
        v = rest;
    }
    qdot_rational_make(y, u, (int64_t)a->den * b->den);
}

static inline int
qdot_rational_sgn(const fmpq *x)
{
    return COEFF_IS_MPZ(x->num) ? fmpq_sgn(x) : (x->num > 0) - (x->num < 0);
}

static inline int
qdot_rational_cmp(const fmpq *a, const fmpq *b)
{
    if (qdot_rational_is_small(a) && qdot_rational_is_small(b)) {
        const int64_t x = (int64_t)a->num * b->den, y = (int64_t)b->num * a->den;

        return (x > y) - (x < y);
    }
    return fmpq_cmp(a, b);
}

static inline bool
qdot_rational_equal(const fmpq *a, const fmpq *b)
{
    if (COEFF_IS_MPZ(a->num) || COEFF_IS_MPZ(a->den))
        return fmpq_equal(a, b);
    return a->num == b->num && a->den == b->den; /* a is small, and FLINT stores a small number in only one way */
}

#endif
