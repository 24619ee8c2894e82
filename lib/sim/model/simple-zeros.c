/* simple-zeros.c -- lowers the exponents of a product. */
#include "sim/model/simple-zeros.h"

/* Whether the exponent is a whole number from `least`. *n out: 1 if it is odd, 2 if it is even. */
static bool
is_whole(const qdot_pool *pool, qdot_expr exponent, long least, long *n)
{
    const fmpq *q = qdot_expr_rational(pool, exponent);

    if (q == NULL || !fmpz_is_one(fmpq_denref(q)) || fmpz_cmp_si(fmpq_numref(q), least) < 0)
        return false;
    *n = fmpz_is_odd(fmpq_numref(q)) ? 1 : 2;
    return true;
}

static bool
is_modulus(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == QDOT_ABS;
}

qdot_expr
qdot_simple_zeros(qdot_pool *pool, qdot_expr g)
{
    qdot_expr e;
    bool lower = false;
    long n;

    if (qdot_expr_kind(pool, g) != QDOT_PROD)
        return g;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, g); i += 2)
        lower = lower || is_whole(pool, qdot_expr_arg(pool, g, i + 1), 3, &n);
    if (!lower)
        return g;
    e = qdot_expr_arg(pool, g, 0);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, g); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, g, i), exponent = qdot_expr_arg(pool, g, i + 1);

        e = qdot_mul(pool, e,
                     is_whole(pool, exponent, 3, &n) ? qdot_pow_int(pool, base, n)
                                                     : qdot_pow(pool, base, exponent));
    }
    return e;
}

qdot_expr
qdot_touching_zeros(qdot_pool *pool, qdot_expr g)
{
    qdot_expr u = QDOT_ONE;

    if (is_modulus(pool, g))
        return qdot_expr_arg(pool, g, 0);
    if (qdot_expr_kind(pool, g) != QDOT_PROD)
        return QDOT_NIL;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, g); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, g, i);
        long n;

        if (!is_whole(pool, qdot_expr_arg(pool, g, i + 1), 1, &n) || (n == 1 && !is_modulus(pool, base)))
            return QDOT_NIL;
        u = qdot_mul(pool, u, is_modulus(pool, base) ? qdot_expr_arg(pool, base, 0) : base);
    }
    return u;
}
