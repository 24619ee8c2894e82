/* scale.c -- multiplies expressions by numbers; makes products and powers whose factors need no merging. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

#include <string.h>

static qdot_expr
multiply_numbers(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    fmpq_t c;
    qdot_expr e;

    if (a == QDOT_ONE || b == QDOT_ONE)
        return a == QDOT_ONE ? b : a;
    fmpq_init(c);
    qdot_rational_mul(c, RATIONAL(pool, a), RATIONAL(pool, b));
    e = qdot_expr_fmpq(pool, c);
    fmpq_clear(c);
    return e;
}

qdot_expr
qdot_sum_turned(qdot_pool *pool, qdot_expr sum)
{
    uint32_t n = NODE(pool, sum)->n;
    qdot_expr few[33], *args = n > 33 ? qdot_malloc(n * sizeof *args) : few, e = QDOT_NIL;

    if (args == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        args[i] = ARGS(pool, sum)[i];
        if (i % 2 == 0)
            args[i] = multiply_numbers(pool, QDOT_MINUS_ONE, args[i]);
    }
    if (!FAILED(pool))
        e = qdot_pool_intern(pool, QDOT_SUM, 0, n, args, qdot_sign_of_sum(pool, n, args));
    if (args != few)
        qdot_free(args);
    return e;
}

/* The expression c e for a number c; the factors of e are copied as they are. */
static qdot_expr
multiply_by_number(qdot_pool *pool, qdot_expr c, qdot_expr e)
{
    uint32_t n = NODE(pool, e)->kind == QDOT_PROD ? NODE(pool, e)->n : 3;
    qdot_expr few[33], *args = few, result = QDOT_NIL;

    if (c == QDOT_ONE || c == QDOT_ZERO)
        return c == QDOT_ONE ? e : c;
    if (NODE(pool, e)->kind == QDOT_NUM)
        return multiply_numbers(pool, c, e);
    if (NODE(pool, e)->kind == QDOT_SUM &&
        (c == QDOT_MINUS_ONE || qdot_expr_is_negative(pool, e))) {
        e = qdot_sum_turned(pool, e);
        c = multiply_numbers(pool, QDOT_MINUS_ONE, c);
        if (c == QDOT_ONE || c == QDOT_NIL || e == QDOT_NIL)
            return c == QDOT_NIL ? c : e;
    }
    if (n > 33 && (args = qdot_malloc(n * sizeof *args)) == NULL)
        return qdot_pool_fail(pool);
    if (NODE(pool, e)->kind == QDOT_PROD) {
        memcpy(args, ARGS(pool, e), n * sizeof *args);
        args[0] = multiply_numbers(pool, c, args[0]);
    } else {
        args[0] = c;
        args[1] = e;
        args[2] = QDOT_ONE;
    }
    if (args[0] == QDOT_NIL)
        result = QDOT_NIL;
    else if (n == 3 && args[2] == QDOT_ONE && args[0] == QDOT_ONE)
        result = args[1];
    else if (n == 3 && args[2] == QDOT_ONE && args[0] == QDOT_MINUS_ONE &&
             NODE(pool, args[1])->kind == QDOT_SUM)
        result = qdot_sum_turned(pool, args[1]);
    else
        result = qdot_pool_intern(pool, QDOT_PROD, 0, n, args,
                                  qdot_sign_of_product(pool, n, args));
    if (args != few)
        qdot_free(args);
    return result;
}

qdot_expr
qdot_expr_strip(qdot_pool *pool, qdot_expr e)
{
    const qdot_node *node = NODE(pool, e);
    qdot_expr few[33], *args = few, stripped;
    uint32_t n = node->n;

    if (node->kind != QDOT_PROD || ARGS(pool, e)[0] == QDOT_ONE)
        return e;
    if (n == 3 && ARGS(pool, e)[2] == QDOT_ONE)
        return ARGS(pool, e)[1];
    if (n > 33 && (args = qdot_malloc(n * sizeof *args)) == NULL)
        return qdot_pool_fail(pool);
    memcpy(args, ARGS(pool, e), n * sizeof *args);
    args[0] = QDOT_ONE;
    stripped = qdot_pool_intern(pool, QDOT_PROD, 0, n, args,
                                qdot_sign_of_product(pool, n, args));
    if (args != few)
        qdot_free(args);
    return stripped;
}

qdot_expr
qdot_expr_unscale(qdot_pool *pool, qdot_expr e, fmpq_t c)
{
    if (NODE(pool, e)->kind == QDOT_NUM) {
        qdot_rational_set(c, RATIONAL(pool, e));
        return QDOT_ONE;
    }
    if (NODE(pool, e)->kind != QDOT_PROD) {
        fmpq_one(c);
        return e;
    }
    qdot_rational_set(c, RATIONAL(pool, ARGS(pool, e)[0]));
    return qdot_expr_strip(pool, e);
}

bool
qdot_expr_is_atom(const qdot_pool *pool, qdot_expr e)
{
    const qdot_node *node = NODE(pool, e);

    return node->kind == QDOT_SYM || node->kind == QDOT_UFUN || node->kind == QDOT_INTEGRAL ||
           (node->kind == QDOT_SUM && !qdot_expr_is_negative(pool, e)) ||
           (node->kind == QDOT_FUN && node->op != QDOT_EXP && node->op != QDOT_ABS);
}

/* Whether b^x is an odd power of a sum of unknown sign, whose sign may be reversed. */
static bool
has_reversible_sign(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    const fmpq *k = NUMBER(pool, x);

    return NODE(pool, b)->kind == QDOT_SUM && !(NODE(pool, b)->sign & QDOT_GE0) &&
           k != NULL && fmpz_is_one(fmpq_denref(k)) && !fmpz_is_even(fmpq_numref(k));
}

static bool
has_minus_term(const qdot_pool *pool, qdot_expr sum)
{
    for (uint32_t k = 0; k < NODE(pool, sum)->n; k += 2)
        if (qdot_rational_sgn(RATIONAL(pool, ARGS(pool, sum)[k])) < 0)
            return true;
    return false;
}

qdot_expr
qdot_expr_turnable(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = NODE(pool, e)->n;
    qdot_expr power = QDOT_NIL; /* a factor that is an odd power of a difference, used if no factor is a difference itself */

    for (uint32_t i = 1; NODE(pool, e)->kind == QDOT_PROD && i < n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];

        if (!has_reversible_sign(pool, b, x) || !has_minus_term(pool, b))
            continue;
        if (x == QDOT_ONE)
            return b;
        if (power == QDOT_NIL)
            power = b;
    }
    return power;
}

qdot_expr
qdot_mul(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (a == QDOT_NIL || b == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (!qdot_pool_is_scalar(pool, a) || !qdot_pool_is_scalar(pool, b))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a number is needed here");
    if (NODE(pool, a)->kind == QDOT_NUM)
        return multiply_by_number(pool, a, b);
    if (NODE(pool, b)->kind == QDOT_NUM)
        return multiply_by_number(pool, b, a);
    if (a != b && qdot_expr_is_atom(pool, a) && qdot_expr_is_atom(pool, b)) {
        bool turned = qdot_expr_compare(pool, a, b) > 0;
        qdot_expr args[] = {QDOT_ONE, turned ? b : a, QDOT_ONE, turned ? a : b, QDOT_ONE};

        return qdot_pool_intern(pool, QDOT_PROD, 0, 5, args,
                                qdot_sign_of_product(pool, 5, args));
    }
    return qdot_product(pool, 2, (qdot_expr[]){a, b});
}

qdot_expr
qdot_pow_int(qdot_pool *pool, qdot_expr a, int64_t n)
{
    return qdot_pow(pool, a, qdot_expr_int(pool, n));
}

qdot_expr
qdot_sqrt(qdot_pool *pool, qdot_expr a)
{
    return qdot_pow(pool, a, QDOT_HALF);
}

qdot_expr
qdot_div(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_mul(pool, a, qdot_pow(pool, b, QDOT_MINUS_ONE));
}
