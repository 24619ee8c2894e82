/* root.c -- rational powers of numbers: exact values, and roots with exact factors taken out. */
#include "expr/exact.h"
#include "expr/pool.h"

#include <stdlib.h>

#include <flint/fmpz.h>
#include <flint/fmpz_factor.h>

enum { LARGEST_ROOT = 10000 };

bool
qdot_number_power(qdot_pool *pool, fmpq_t y, const fmpq_t x, const fmpz_t n)
{
    ulong bits, den;

    if (fmpq_is_zero(x) || fmpq_is_one(x)) {
        qdot_rational_set(y, x);
        return true;
    }
    if (qdot_rational_is_small(x) && *n >= -4 && *n <= 4) {
        fmpq base = *x;

        if (*n < 0)
            base = x->num < 0 ? (fmpq){-x->den, -x->num} : (fmpq){x->den, x->num};
        fmpq_one(y);
        for (slong k = *n < 0 ? -*n : *n; k > 0; k--)
            qdot_rational_mul(y, y, &base);
        return true;
    }
    bits = (ulong)fmpz_bits(fmpq_numref(x));
    den = (ulong)fmpz_bits(fmpq_denref(x));
    if (bits < den)
        bits = den;
    if (fmpz_is_pm1(fmpq_numref(x)) && fmpz_is_one(fmpq_denref(x))) {
        fmpq_set_si(y, fmpz_is_even(n) ? 1 : -1, 1);
        return true;
    }
    if (!fmpz_fits_si(n) ||
        (ulong)llabs(fmpz_get_si(n)) > QDOT_MAX_BITS / (bits > 1 ? bits - 1 : 1)) {
        qdot_pool_refuse(pool, QDOT_ELIMIT, "an exact number of more than 10^6 digits");
        return false;
    }
    fmpq_pow_si(y, x, fmpz_get_si(n));
    return true;
}

/* Write n = outside^q * inside, n > 0, where inside contains no q-th powers of the primes found. */
static void
extract_powers_from_root(fmpz_t outside, fmpz_t inside, const fmpz_t n, ulong q)
{
    fmpz_factor_t f;
    fmpz_t power;

    fmpz_one(outside);
    fmpz_init(power);
    if (fmpz_root(power, n, (slong)q)) { /* n is the q-th power of an integer */
        fmpz_set(outside, power);
        fmpz_one(inside);
        fmpz_clear(power);
        return;
    }
    fmpz_set(inside, n);
    fmpz_factor_init(f);
    /* from numbers of more than 64 bits only small primes are taken out of the root: still correct, perhaps not simplest */
    if (fmpz_bits(n) <= 64)
        fmpz_factor(f, n);
    else
        fmpz_factor_trial_range(f, n, 0, 3000);
    for (slong i = 0; i < f->num; i++) {
        fmpz_pow_ui(power, f->p + i, f->exp[i] / q);
        fmpz_mul(outside, outside, power);
        fmpz_pow_ui(power, power, q);
        fmpz_divexact(inside, inside, power);
    }
    fmpz_factor_clear(f);
    fmpz_clear(power);
}

/* Write inside^(1/q) as inside^(1/g) with the smallest possible g: 4^(1/4) is 2^(1/2). Returns g. */
static ulong
reduce_degree_of_root(fmpz_t inside, ulong q)
{
    fmpz_t root;
    ulong g = q;

    fmpz_init(root);
    for (ulong d = q; d > 1; d--)
        if (q % d == 0 && fmpz_bits(inside) > d && fmpz_root(root, inside, (slong)d)) {
            fmpz_set(inside, root);
            g = q / d;
            break;
        }
    fmpz_clear(root);
    return g;
}

bool
qdot_number_root(qdot_pool *pool, const fmpq_t b, const fmpq_t e, fmpq_t c,
                 qdot_expr *base, qdot_expr *exponent)
{
    fmpz_t whole, part, outside, inside, all;
    fmpq_t rest;
    ulong q, k;
    bool small, good;

    *base = *exponent = QDOT_ONE;
    if (qdot_rational_sgn(b) < 0) {
        qdot_pool_refuse(pool, QDOT_EDOMAIN, "a root of a negative number is not real");
        return false;
    }
    fmpz_init(whole);
    fmpz_init(part);
    fmpz_init(outside);
    fmpz_init(inside);
    fmpz_init(all);
    fmpq_init(rest);
    small = fmpz_cmp_ui(fmpq_denref(e), LARGEST_ROOT) <= 0;
    q = small ? fmpz_get_ui(fmpq_denref(e)) : 0;
    small = small && (uint64_t)(fmpz_bits(fmpq_numref(b)) + fmpz_bits(fmpq_denref(b))) * q <=
                         QDOT_MAX_BITS;
    fmpz_fdiv_qr(whole, part, fmpq_numref(e), fmpq_denref(e));
    good = qdot_number_power(pool, c, b, whole);
    if (good && !small) {
        fmpq_set_fmpz_frac(rest, part, fmpq_denref(e));
        *base = qdot_expr_fmpq(pool, b);
        *exponent = qdot_expr_fmpq(pool, rest);
    } else if (good) {
        /* (n/d)^(k/q) = (n^k d^(q - k))^(1/q) / d */
        k = fmpz_get_ui(part);
        fmpz_pow_ui(all, fmpq_numref(b), k);
        fmpz_pow_ui(inside, fmpq_denref(b), q - k);
        fmpz_mul(all, all, inside);
        fmpq_div_fmpz(c, c, fmpq_denref(b));
        extract_powers_from_root(outside, inside, all, q);
        fmpq_mul_fmpz(c, c, outside);
        if (!fmpz_is_one(inside)) {
            q = reduce_degree_of_root(inside, q);
            fmpq_set_fmpz(rest, inside);
            *base = qdot_expr_fmpq(pool, rest);
            *exponent = qdot_expr_ratio(pool, 1, (int64_t)q);
        }
    }
    fmpq_clear(rest);
    fmpz_clear(whole);
    fmpz_clear(part);
    fmpz_clear(outside);
    fmpz_clear(inside);
    fmpz_clear(all);
    return good && *base != QDOT_NIL && *exponent != QDOT_NIL;
}
