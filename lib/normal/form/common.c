/* common.c -- what all terms of a sum share, in front:
 *
 *     1/2 m a^2 x'^2 + 1/2 m a^2 W^2 sin(x)^2 = 1/2 m a^2 (x'^2 + W^2 sin(x)^2).
 *
 * A factor of which something stays in a term is left there, and so is a number unless it is
 * the same in all.
 */
#include "normal/form/common.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

/* The exponent of the base b in a term; nil if no power of b is a factor of the term. */
static qdot_expr
exponent_in(const qdot_pool *pool, qdot_expr term, qdot_expr b)
{
    if (term == b)
        return QDOT_ONE;
    for (uint32_t i = 1;
         qdot_expr_kind(pool, term) == QDOT_PROD && i < qdot_expr_count(pool, term);
         i += 2)
        if (qdot_expr_arg(pool, term, i) == b)
            return qdot_expr_arg(pool, term, i + 1);
    return QDOT_NIL;
}

/* The number of terms of a sum that contain the factor b; *alike: always with the exponent x. */
static uint32_t
count_terms_with_factor(const qdot_pool *pool, qdot_expr sum, qdot_expr b, qdot_expr x, bool *alike)
{
    uint32_t count = 0;

    *alike = true;
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2) {
        qdot_expr y = exponent_in(pool, qdot_expr_arg(pool, sum, i), b);

        count += y != QDOT_NIL;
        *alike &= y == x;
    }
    return count;
}

/* The common coefficient of a sum: |c| if all are c or -c; 1 if all are integers; else 0. */
static qdot_expr
shared_number(qdot_pool *pool, qdot_expr sum)
{
    qdot_expr first = qdot_expr_arg(pool, sum, 2);
    qdot_expr minus = qdot_neg(pool, first);
    bool same = true, whole = true;

    for (uint32_t i = 2; i < qdot_expr_count(pool, sum); i += 2) {
        qdot_expr c = qdot_expr_arg(pool, sum, i);

        same &= c == first || c == minus;
        whole &= fmpz_is_one(fmpq_denref(qdot_expr_rational(pool, c)));
    }
    if (!same)
        return whole ? QDOT_ONE : QDOT_ZERO;
    return qdot_expr_is_negative(pool, first) ? minus : first;
}

/* The shared factors of a SUM; 1: none. A factor that is in all, but not alike, leaves the sum as
 * it is: L1 stays in (m1 + m2)*L1^2*x'' + m2*L1*L2*y'', and m2 with it. */
static qdot_expr
common_factors(qdot_pool *pool, qdot_expr sum)
{
    qdot_expr term = qdot_expr_arg(pool, sum, 1), number = shared_number(pool, sum);
    bool product = qdot_expr_kind(pool, term) == QDOT_PROD, alike;
    uint32_t n = product ? qdot_expr_count(pool, term) : 2;
    uint32_t terms = (qdot_expr_count(pool, sum) - 1) / 2;
    const uint32_t fast = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |
                          QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;
    qdot_expr c = QDOT_ONE;

    for (uint32_t i = 1; i < n && c != QDOT_NIL; i += 2) {
        qdot_expr b = product ? qdot_expr_arg(pool, term, i) : term;
        qdot_expr x = product ? qdot_expr_arg(pool, term, i + 1) : QDOT_ONE;

        if ((qdot_expr_node(pool, b)->holds & fast) ||
            count_terms_with_factor(pool, sum, b, x, &alike) < terms)
            continue;
        if (!alike)
            return QDOT_ONE;
        c = qdot_mul(pool, c, qdot_pow(pool, b, x));
    }
    return c == QDOT_ONE || number == QDOT_ZERO ? QDOT_ONE : qdot_mul(pool, number, c);
}

static qdot_expr
factor_sum(qdot_pool *pool, qdot_expr sum)
{
    qdot_expr c, rest = QDOT_ZERO;

    if (qdot_expr_arg(pool, sum, 0) != QDOT_ZERO || qdot_expr_count(pool, sum) < 5)
        return sum;
    c = common_factors(pool, sum);
    if (c == QDOT_ONE || c == QDOT_NIL)
        return sum;
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2)
        rest = qdot_add(pool, rest,
                        qdot_div(pool,
                                 qdot_mul(pool, qdot_expr_arg(pool, sum, i + 1),
                                          qdot_expr_arg(pool, sum, i)),
                                 c));
    return qdot_mul(pool, c, rest);
}

/* The index of the only factor of a product that is a sum to the first power; 0 if there is none or several. */
static uint32_t
only_sum_factor(const qdot_pool *pool, qdot_expr product)
{
    uint32_t at = 0;

    for (uint32_t i = 1; i < qdot_expr_count(pool, product); i += 2)
        if (qdot_expr_kind(pool, qdot_expr_arg(pool, product, i)) == QDOT_SUM &&
            qdot_expr_arg(pool, product, i + 1) == QDOT_ONE) {
            if (at != 0)
                return 0;
            at = i;
        }
    return at;
}

/* Undo a fraction in front of a sum: 1/4 m (2 x'^2 + R^2 y'^2) becomes 1/2 m x'^2 + 1/4 m R^2 y'^2. */
static qdot_expr
without_fraction(qdot_pool *pool, qdot_expr product, qdot_expr sum)
{
    qdot_expr front = qdot_div(pool, product, sum), result = QDOT_ZERO;
    const fmpq *c = qdot_expr_rational(pool, qdot_expr_arg(pool, product, 0));

    if (fmpz_is_one(fmpq_denref(c)) || qdot_expr_arg(pool, sum, 0) != QDOT_ZERO)
        return product;
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2)
        if (!(qdot_expr_node(pool, qdot_expr_arg(pool, sum, i))->holds &
              QDOT_HAS_VELOCITY))
            return product;
    for (uint32_t i = 2; i < qdot_expr_count(pool, sum); i += 2)
        if (qdot_expr_arg(pool, sum, i) != QDOT_ONE &&
            qdot_expr_arg(pool, sum, i) != QDOT_MINUS_ONE) {
            for (uint32_t k = 1; k < qdot_expr_count(pool, sum); k += 2)
                result = qdot_add(pool, result,
                                  qdot_mul(pool, front,
                                           qdot_mul(pool, qdot_expr_arg(pool, sum, k + 1),
                                                    qdot_expr_arg(pool, sum, k))));
            return result;
        }
    return product;
}

qdot_expr
qdot_common_out(qdot_pool *pool, qdot_expr e)
{
    qdot_expr sum, other;
    uint32_t at;

    if (e == QDOT_NIL)
        return e;
    if (qdot_expr_kind(pool, e) == QDOT_SUM) {
        other = factor_sum(pool, e);
        return other != QDOT_NIL && qdot_expr_size(pool, other) < qdot_expr_size(pool, e)
                   ? other
                   : e;
    }
    at = qdot_expr_kind(pool, e) == QDOT_PROD ? only_sum_factor(pool, e) : 0;
    if (at == 0)
        return e;
    sum = qdot_expr_arg(pool, e, at);
    other = factor_sum(pool, sum);
    if (other != sum && other != QDOT_NIL) {
        other = qdot_mul(pool, qdot_div(pool, e, sum), other);
        return qdot_expr_size(pool, other) <= qdot_expr_size(pool, e) ? other : e;
    }
    return without_fraction(pool, e, sum);
}
