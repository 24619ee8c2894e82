/* factor-signs.c -- signs of the factors of an expression, from known signs and from the bounds of cosines. */
#include "normal/inequality/factor-signs.h"

#include "expr/build.h"
#include "expr/node.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"

enum { WORK = 4000000, MOST_ENDS = 5 };

static uint8_t
product_of_signs(uint8_t a, uint8_t b)
{
    const uint8_t either = QDOT_GE0 | QDOT_LE0;
    uint8_t known = 0;

    if (((a & QDOT_GE0) && (b & QDOT_GE0)) || ((a & QDOT_LE0) && (b & QDOT_LE0)))
        known = QDOT_GE0;
    else if ((a & either) && (b & either))
        known = QDOT_LE0;
    return (uint8_t)(known | (a & b & QDOT_NE0));
}

/* The sign of a linear function between two ends, if it is the same at both. */
static uint8_t
common_sign(uint8_t a, uint8_t b)
{
    return a & b & (QDOT_GE0 | QDOT_LE0) ? (uint8_t)(a & b) : 0;
}

static uint8_t polynomial_sign(qdot_field *f, const fmpz_mpoly_t p, int depth);

/* The sign of p = A x + B with x in [-1, 1] or [1, oo), from its values at the ends. depth bounds
 * the recursion. */
static uint8_t
sign_from_ends(qdot_field *f, const fmpz_mpoly_t p, slong v, int depth)
{
    fmpz_mpoly_t at_one, at_other;
    uint8_t sign;
    fmpz_t end;

    fmpz_init_set_si(end, 1);
    fmpz_mpoly_init(at_one, f->ctx);
    fmpz_mpoly_init(at_other, f->ctx);
    fmpz_mpoly_evaluate_one_fmpz(at_one, p, v, end, f->ctx);
    if (f->gen[v].kind == QDOT_GEN_COSH) {
        fmpz_mpoly_derivative(at_other, p, v,
                              f->ctx); /* the sign of A itself, at least as >= 0 */
        sign =
            common_sign(polynomial_sign(f, at_one, depth), polynomial_sign(f, at_other, depth) | QDOT_NE0);
    } else {
        fmpz_set_si(end, -1);
        fmpz_mpoly_evaluate_one_fmpz(at_other, p, v, end, f->ctx);
        sign = common_sign(polynomial_sign(f, at_one, depth), polynomial_sign(f, at_other, depth));
    }
    fmpz_clear(end);
    fmpz_mpoly_clear(at_one, f->ctx);
    fmpz_mpoly_clear(at_other, f->ctx);
    return sign;
}

static bool
is_free_cosine(const qdot_field *f, const fmpz_mpoly_t p, slong v)
{
    qdot_gen_kind kind = f->gen[v].kind;

    return (kind == QDOT_GEN_COS || kind == QDOT_GEN_SIN || kind == QDOT_GEN_COSH) &&
           fmpz_mpoly_degree_si(p, v, f->ctx) == 1 &&
           fmpz_mpoly_degree_si(p, (slong)f->gen[v].pair, f->ctx) == 0;
}

static uint8_t
polynomial_sign(qdot_field *f, const fmpz_mpoly_t p, int depth)
{
    uint8_t sign;

    if (fmpz_mpoly_is_zero(p, f->ctx))
        return QDOT_GE0 | QDOT_LE0;
    sign = qdot_expr_sign(f->pool, qdot_field_expr(f, p));
    if ((sign & (QDOT_GE0 | QDOT_LE0)) && (sign & QDOT_NE0))
        return sign;
    for (slong v = 0; v < f->n && depth > 0; v++)
        if (is_free_cosine(f, p, v)) {
            uint8_t here = sign_from_ends(f, p, v, depth - 1);

            if (here != 0)
                return here | sign;
        }
    return sign;
}

static uint8_t
product_sign(qdot_field *f, const fmpz_mpoly_t p)
{
    qdot_factors factors;
    uint8_t sign = 0;

    if (fmpz_mpoly_is_zero(p, f->ctx))
        return QDOT_GE0 | QDOT_LE0;
    if (qdot_factor(f, &factors, p) == QDOT_OK) {
        sign = fmpz_sgn(factors.content) > 0 ? QDOT_POS : QDOT_NEG;
        for (slong i = 0; i < factors.n; i++) {
            uint8_t one = polynomial_sign(f, factors.poly + i, MOST_ENDS);

            if (factors.exp[i] % 2 == 0)
                one = (uint8_t)(QDOT_GE0 | (one & QDOT_NE0));
            sign = product_of_signs(sign, one);
        }
    }
    qdot_factor_clear(f, &factors);
    return sign;
}

uint8_t
qdot_sign_by_factors(qdot_pool *pool, qdot_expr e)
{
    uint8_t sign = 0;
    const qdot_ratio *r;
    qdot_field f;

    e = qdot_prepare(pool, e);
    qdot_field_begin(&f, pool, 1, &e, WORK);
    r = qdot_field_value(&f, e);
    if (r != NULL) {
        qdot_ratio x;

        qdot_ratio_init(&f, &x);
        qdot_ratio_set(&f, &x, r);
        qdot_ratio_cancel(&f, &x);
        if (qdot_field_goes(&f))
            sign = product_of_signs(product_sign(&f, x.n),
                                    product_sign(&f, x.d) | QDOT_NE0);
        for (slong v = 0; v < f.n && sign == 0 && qdot_field_goes(&f); v++)
            if (f.gen[v].kind == QDOT_GEN_COS &&
                qdot_factor_flip(&f, x.n, x.n, v) == QDOT_OK)
                sign = product_of_signs(product_sign(&f, x.n),
                                        product_sign(&f, x.d) | QDOT_NE0);
        qdot_ratio_clear(&f, &x);
    }
    qdot_field_end(&f);
    return sign;
}

/* The product of those factors of p whose sign is not known, once or twice, to the power `turn`, 1 or -1. *sign: times
 * that of the others, 0 where p cannot be factored; *less: there are others. */
static qdot_expr
product_of_unsigned_factors(qdot_field *f, const fmpz_mpoly_t p, int64_t turn, int *sign,
                            bool *less)
{
    qdot_pool *pool = f->pool;
    qdot_expr product = QDOT_ONE;
    qdot_factors factors;

    if (fmpz_mpoly_is_zero(p, f->ctx) || qdot_factor(f, &factors, p) != QDOT_OK) {
        *sign = 0;
        return product;
    }
    *sign *= fmpz_sgn(factors.content);
    for (slong i = 0; i < factors.n; i++) {
        const uint8_t one = polynomial_sign(f, factors.poly + i, MOST_ENDS);
        const bool odd = factors.exp[i] % 2 != 0;

        if ((one & QDOT_POS) == QDOT_POS || (one & QDOT_NEG) == QDOT_NEG) {
            *sign = odd && (one & QDOT_NEG) == QDOT_NEG ? -*sign : *sign;
            *less = true;
        } else {
            product = qdot_mul(pool, product,
                               qdot_pow_int(pool, qdot_field_expr(f, factors.poly + i),
                                            turn * (odd ? 1 : 2)));
        }
    }
    qdot_factor_clear(f, &factors);
    return product;
}

qdot_expr
qdot_without_signed_factors(qdot_pool *pool, qdot_expr e)
{
    qdot_expr prepared = qdot_prepare(pool, e), rest = e;
    const qdot_ratio *r;
    qdot_field f;

    qdot_field_begin(&f, pool, 1, &prepared, WORK);
    r = qdot_field_value(&f, prepared);
    if (r != NULL) {
        bool less = false;
        int sign = 1;
        qdot_expr above, below;
        qdot_ratio x;

        qdot_ratio_init(&f, &x);
        qdot_ratio_set(&f, &x, r);
        qdot_ratio_cancel(&f, &x);
        above = product_of_unsigned_factors(&f, x.n, 1, &sign, &less);
        below = product_of_unsigned_factors(&f, x.d, -1, &sign, &less);
        if (qdot_field_goes(&f) && sign != 0 && less)
            rest = qdot_mul(pool, sign > 0 ? QDOT_ONE : QDOT_MINUS_ONE,
                            qdot_mul(pool, above, below));
        qdot_ratio_clear(&f, &x);
    }
    qdot_field_end(&f);
    return rest;
}
