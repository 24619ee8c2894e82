/* simple-zeros.c -- removes repeated zeros of a product by reducing the exponents of its factors. */
#include "sim/model/simple-zeros.h"

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"

/* Whether an exponent is an integer; *n: 1 if it is odd, 2 if even, with the sign of the exponent. */
static bool
exponent_is_whole(const qdot_pool *pool, qdot_expr exponent, int64_t *n)
{
    const fmpq *q = qdot_expr_rational(pool, exponent);

    if (q == NULL || !fmpz_is_one(fmpq_denref(q)))
        return false;
    *n = fmpz_sgn(fmpq_numref(q)) * (fmpz_is_odd(fmpq_numref(q)) ? 1 : 2);
    return true;
}

/* The binary exponent of a number if it is extremely large or small; 0 for other numbers. */
static int64_t
extreme_exponent(const qdot_pool *pool, qdot_expr number)
{
    enum { FAR = 500 };
    const fmpq *q = qdot_expr_rational(pool, number);
    const int64_t e = q == NULL || fmpq_is_zero(q) ? 0
                                                : (int64_t)fmpz_bits(fmpq_numref(q)) - (int64_t)fmpz_bits(fmpq_denref(q));

    return e > FAR || e < -FAR ? e : 0;
}

/* Multiply a sum by a power of 2 if all its coefficients are extremely large, or all extremely small. */
static qdot_expr
scale_extreme_sum(qdot_pool *pool, qdot_expr sum)
{
    int64_t most = extreme_exponent(pool, qdot_expr_arg(pool, sum, 0));
    qdot_expr by, e;

    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, sum); k += 2) {
        const int64_t here = extreme_exponent(pool, qdot_expr_arg(pool, sum, k + 1));

        if (here == 0)
            return sum;
        most = most == 0 || here > most ? here : most;
    }
    if (qdot_expr_arg(pool, sum, 0) != QDOT_ZERO && extreme_exponent(pool, qdot_expr_arg(pool, sum, 0)) == 0)
        return sum;
    by = qdot_pow_int(pool, qdot_expr_int(pool, 2), -most);
    e = qdot_mul(pool, by, qdot_expr_arg(pool, sum, 0));
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, sum); k += 2)
        e = qdot_add(pool, e,
                     qdot_mul(pool, qdot_mul(pool, by, qdot_expr_arg(pool, sum, k + 1)), qdot_expr_arg(pool, sum, k)));
    return e;
}

qdot_expr
qdot_simple_zeros(qdot_pool *pool, qdot_expr g)
{
    qdot_expr e;

    if (qdot_expr_kind(pool, g) == QDOT_SUM)
        return scale_extreme_sum(pool, g);
    if (qdot_expr_kind(pool, g) != QDOT_PROD)
        return g;
    e = qdot_expr_arg(pool, g, 0);
    if (extreme_exponent(pool, e) != 0)
        e = qdot_expr_is_negative(pool, e) ? qdot_neg(pool, QDOT_ONE) : QDOT_ONE;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, g); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, g, i), exponent = qdot_expr_arg(pool, g, i + 1);
        int64_t n;

        e = qdot_mul(pool, e,
                     exponent_is_whole(pool, exponent, &n) ? qdot_pow_int(pool, base, n)
                                                           : qdot_pow(pool, base, exponent));
    }
    return e;
}

qdot_expr
qdot_touching_zeros(qdot_pool *pool, qdot_expr g)
{
    qdot_expr u = QDOT_ONE;

    if (qdot_expr_is_function(pool, g, QDOT_ABS))
        return qdot_expr_arg(pool, g, 0);
    if (qdot_expr_kind(pool, g) != QDOT_PROD)
        return QDOT_NIL;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, g); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, g, i);
        const bool modulus = qdot_expr_is_function(pool, base, QDOT_ABS);
        int64_t n;

        if (!exponent_is_whole(pool, qdot_expr_arg(pool, g, i + 1), &n) || n < 0 || (n == 1 && !modulus))
            return QDOT_NIL;
        u = qdot_mul(pool, u, modulus ? qdot_expr_arg(pool, base, 0) : base);
    }
    return u;
}
