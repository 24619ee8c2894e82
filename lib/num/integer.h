/* integer.h -- integers of 64 bits as integers and rationals of FLINT, whose own words have 64 or 32 bits.
 *
 * FLINT's functions _si and _ui, its exponents and its small integers have a word: where numbers come from, or go to, the
 * rest of the program, these are called instead.
 *
 * Tests  tests/num/test_integer.c
 */
#ifndef QDOT_NUM_INTEGER_H
#define QDOT_NUM_INTEGER_H

#include <stdbool.h>
#include <stdint.h>

#include <flint/fmpq.h>

static inline void
qdot_integer_set_unsigned(fmpz_t x, uint64_t n)
{
#if FLINT_BITS == 64
    fmpz_set_ui(x, n);
#else
    fmpz_set_uiui(x, (ulong)(n >> 32), (ulong)n);
#endif
}

static inline void
qdot_integer_set(fmpz_t x, int64_t n)
{
#if FLINT_BITS == 64
    fmpz_set_si(x, n);
#else
    qdot_integer_set_unsigned(x, n < 0 ? -(uint64_t)n : (uint64_t)n);
    if (n < 0)
        fmpz_neg(x, x);
#endif
}

/* Whether -2^63 <= x < 2^63. */
static inline bool
qdot_integer_fits(const fmpz_t x)
{
#if FLINT_BITS == 64
    return fmpz_fits_si(x);
#else
    const flint_bitcnt_t bits = fmpz_bits(x);

    return bits < 64 || (bits == 64 && fmpz_sgn(x) < 0 && fmpz_val2(x) == 63);
#endif
}

/* The value of an integer that fits. */
static inline int64_t
qdot_integer_get(const fmpz_t x)
{
#if FLINT_BITS == 64
    return fmpz_get_si(x);
#else
    ulong high, low;

    fmpz_get_signed_uiui(&high, &low, x);
    return (int64_t)((uint64_t)high << 32 | low);
#endif
}

/* Set x = n/d, d > 0, in lowest terms. */
static inline void
qdot_rational_set_integers(fmpq_t x, int64_t n, uint64_t d)
{
    qdot_integer_set(fmpq_numref(x), n);
    qdot_integer_set_unsigned(fmpq_denref(x), d);
    fmpq_canonicalise(x);
}

/* Whether x equals k, which has less than 62 bits. */
static inline bool
qdot_integer_is(const fmpz_t x, int64_t k)
{
#if FLINT_BITS == 64
    return *x == k;
#else
    return k >= COEFF_MIN && k <= COEFF_MAX ? *x == k : qdot_integer_fits(x) && qdot_integer_get(x) == k;
#endif
}

#endif
