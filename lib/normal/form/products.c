/* products.c -- rewrites every product in an expression: quotients as tan and cot, signs in front. */
#include "normal/form/products.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/form/common.h"

/* Write sin(a)^m cos(a)^-n in a product by tan(a)^min(m, n) and what remains, likewise cot and tanh. */
static qdot_expr
write_tangents(qdot_pool *pool, qdot_expr e, void *user)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr result = e;

    (void)user;
    for (uint32_t i = 1; i < n; i += 2)
        for (uint32_t j = 1; j < n; j += 2) {
            qdot_expr s = qdot_expr_arg(pool, e, i), c = qdot_expr_arg(pool, e, j), t;
            qdot_fun_id quotient = QDOT_TAN;
            int64_t m, k;

            if (qdot_expr_kind(pool, s) != QDOT_FUN ||
                qdot_expr_kind(pool, c) != QDOT_FUN ||
                qdot_expr_arg(pool, s, 0) != qdot_expr_arg(pool, c, 0) ||
                !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &m) ||
                !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, j + 1), &k))
                continue;
            if (qdot_expr_node(pool, s)->op == QDOT_SINH &&
                qdot_expr_node(pool, c)->op == QDOT_COSH)
                quotient = QDOT_TANH;
            else if (qdot_expr_node(pool, s)->op != QDOT_SIN ||
                     qdot_expr_node(pool, c)->op != QDOT_COS)
                continue;
            if (quotient == QDOT_TAN && m < 0 && k > 0) { /* cos^k sin^m with m < 0: write cot */
                quotient = QDOT_COT;
                m = -m;
                k = -k;
                t = s;
                s = c;
                c = t;
            }
            if (m <= 0 || k >= 0)
                continue;
            if (m > -k)
                m = -k;
            t = qdot_fun1(pool, quotient, qdot_expr_arg(pool, s, 0));
            t = qdot_mul(pool, qdot_pow_int(pool, t, m), qdot_pow_int(pool, s, -m));
            result = qdot_mul(pool, qdot_mul(pool, result, t), qdot_pow_int(pool, c, m));
        }
    return result;
}

static bool
all_terms_negative(const qdot_pool *pool, qdot_expr sum)
{
    uint32_t n = qdot_expr_count(pool, sum);
    bool all = fmpq_sgn(qdot_expr_rational(pool, qdot_expr_arg(pool, sum, 0))) <= 0;

    for (uint32_t i = 2; i < n && all; i += 2)
        all = fmpq_sgn(qdot_expr_rational(pool, qdot_expr_arg(pool, sum, i))) < 0;
    return all;
}

/* Write (-a - b)*c as -(a + b)*c. */
static qdot_expr
move_signs_to_front(qdot_pool *pool, qdot_expr e, void *user)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr few[24], *factor = few, result;
    bool any = false;
    int64_t k;

    (void)user;
    if (n > 24 || n < 5)
        return e;
    factor[0] = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1);

        if (qdot_expr_kind(pool, b) == QDOT_SUM && qdot_expr_to_int(pool, x, &k) &&
            all_terms_negative(pool, b)) {
            any = true;
            b = qdot_neg(pool, b);
            if (k % 2 != 0)
                factor[0] = qdot_neg(pool, factor[0]);
        }
        factor[(i + 1) / 2] = qdot_pow(pool, b, x);
    }
    if (!any)
        return e;
    result = qdot_product(pool, (n + 1) / 2, factor);
    return result;
}

/* Multiply a fraction c into a sum if that is shorter: v^2/4 + x^2 for (v^2 + 4 x^2)/4. */
static qdot_expr
multiply_number_into_sum(qdot_pool *pool, qdot_expr e)
{
    qdot_expr sum, rest = QDOT_ZERO, c = qdot_expr_arg(pool, e, 0);

    if (qdot_expr_count(pool, e) != 3 || qdot_expr_arg(pool, e, 2) != QDOT_ONE ||
        fmpz_is_one(fmpq_denref(qdot_expr_rational(pool, c))))
        return e;
    sum = qdot_expr_arg(pool, e, 1);
    if (qdot_expr_kind(pool, sum) != QDOT_SUM)
        return e;
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2)
        rest = qdot_add(pool, rest,
                        qdot_mul(pool, qdot_mul(pool, c, qdot_expr_arg(pool, sum, i + 1)),
                                 qdot_expr_arg(pool, sum, i)));
    rest = qdot_add(pool, rest, qdot_mul(pool, c, qdot_expr_arg(pool, sum, 0)));
    return rest != QDOT_NIL && qdot_expr_size(pool, rest) < qdot_expr_size(pool, e) ? rest
                                                                                    : e;
}

/* Multiply the number c of a product c (c1 a + ...) x into its sum if that is shorter. */
static qdot_expr
multiply_number_into_factor(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr c = qdot_expr_arg(pool, e, 0);

    (void)user;
    if (qdot_expr_count(pool, e) == 3 ||
        fmpz_is_one(fmpq_denref(qdot_expr_rational(pool, c))))
        return multiply_number_into_sum(pool, e);
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), one, result;

        if (qdot_expr_kind(pool, b) != QDOT_SUM ||
            qdot_expr_arg(pool, e, i + 1) != QDOT_ONE)
            continue;
        one = qdot_mul(pool, c, b);
        if (one == QDOT_NIL || qdot_expr_kind(pool, one) != QDOT_PROD)
            continue;
        one = multiply_number_into_sum(pool, one);
        if (one == QDOT_NIL || qdot_expr_kind(pool, one) != QDOT_SUM)
            continue;
        result = qdot_mul(pool, qdot_div(pool, e, qdot_mul(pool, c, b)), one);
        if (result != QDOT_NIL && qdot_expr_size(pool, result) < qdot_expr_size(pool, e))
            return result;
    }
    return e;
}

qdot_expr
qdot_products_numbers(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_PROD, multiply_number_into_factor, NULL);
}

qdot_expr
qdot_products_tangents(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_PROD, write_tangents, NULL);
}

qdot_expr
qdot_products_signs(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_PROD, move_signs_to_front, NULL);
}

/* Write sin(2 a) as 2 sin(a) cos(a). */
static qdot_expr
expand_double_angle(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr a = qdot_expr_arg(pool, e, 0), half;
    bool even =
        qdot_expr_kind(pool, a) == QDOT_SUM || qdot_expr_kind(pool, a) == QDOT_PROD;

    (void)user;
    if (qdot_expr_node(pool, e)->op != QDOT_SIN)
        return e;
    for (uint32_t i = 0; i < qdot_expr_count(pool, a) && even; i += 2) {
        const fmpq *c = qdot_expr_rational(pool, qdot_expr_arg(pool, a, i));

        even = fmpz_is_one(fmpq_denref(c)) && fmpz_is_even(fmpq_numref(c));
        if (qdot_expr_kind(pool, a) == QDOT_PROD)
            break;
    }
    if (!even)
        return e;
    half = qdot_expand(pool, qdot_mul(pool, QDOT_HALF, a));
    return qdot_mul(
        pool, qdot_expr_int(pool, 2),
        qdot_mul(pool, qdot_fun1(pool, QDOT_SIN, half), qdot_fun1(pool, QDOT_COS, half)));
}

/* The least power of a function in the terms of a sum, out: sin(a)*cos(a)*x + sin(a)^2*y =
 * sin(a)*(cos(a)*x + sin(a)*y). */
static qdot_expr
take_out_function(qdot_pool *pool, qdot_expr sum, void *user)
{
    qdot_expr first, best = sum;

    (void)user;
    sum = best = qdot_common_out(pool, sum);
    if (sum == QDOT_NIL || qdot_expr_kind(pool, sum) != QDOT_SUM ||
        qdot_expr_arg(pool, sum, 0) != QDOT_ZERO || qdot_expr_count(pool, sum) < 5)
        return sum;
    first = qdot_expr_arg(pool, sum, 1);
    for (uint32_t i = 1;
         qdot_expr_kind(pool, first) == QDOT_PROD && i < qdot_expr_count(pool, first);
         i += 2) {
        qdot_expr b = qdot_expr_arg(pool, first, i), rest = QDOT_ZERO;
        bool all = qdot_expr_kind(pool, b) == QDOT_FUN;

        for (uint32_t k = 1; k < qdot_expr_count(pool, sum) && all; k += 2) {
            qdot_expr term = qdot_expr_arg(pool, sum, k);
            int64_t power = 0;

            for (uint32_t v = 1; qdot_expr_kind(pool, term) == QDOT_PROD &&
                                 v < qdot_expr_count(pool, term);
                 v += 2)
                if (qdot_expr_arg(pool, term, v) == b &&
                    !qdot_expr_to_int(pool, qdot_expr_arg(pool, term, v + 1), &power))
                    power = 0;
            all = power > 0 || term == b;
            rest = qdot_add(
                pool, rest,
                qdot_mul(pool, qdot_expr_arg(pool, sum, k + 1), qdot_div(pool, term, b)));
        }
        if (!all)
            continue;
        rest = qdot_mul(pool, b, rest);
        if (rest != QDOT_NIL && qdot_expr_size(pool, rest) < qdot_expr_size(pool, best))
            best = rest;
    }
    return best;
}

qdot_expr
qdot_products_out(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, qdot_walk_replace(pool, e, QDOT_FUN, expand_double_angle, NULL),
                             QDOT_SUM, take_out_function, NULL);
}
