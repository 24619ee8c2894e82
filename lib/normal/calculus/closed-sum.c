/* closed-sum.c -- evaluates sums of very many terms by formulas. */
#include "normal/calculus/closed-sum.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"

enum { MOST_POWER = 200 };

typedef struct {
    qdot_pool *pool;
    qdot_expr k;
    int64_t first, last;
} range;

static qdot_status
fail_without_formula(void)
{
    return qdot_fail(QDOT_EFAILED, "no formula is known");
}

/* Sums of k^0 ... k^p over 0..n, for negative n too: with them
 * (n+1)^(p+1) = sum_j binomial(p+1, j) S_j(n). */
static qdot_status
sums_of_powers(range *r, int64_t n, int64_t p, qdot_expr *S)
{
    qdot_pool *pool = r->pool;
    const qdot_expr next = qdot_add(pool, qdot_expr_int(pool, n), QDOT_ONE);

    for (int64_t i = 0; i <= p; i++) {
        qdot_expr sum = qdot_pow(pool, next, qdot_expr_int(pool, i + 1)),
                  binomial = QDOT_ONE; /* the binomial coefficient (i+1 over j) */

        for (int64_t j = 0; j < i; j++) {
            sum = qdot_sub(pool, sum, qdot_mul(pool, binomial, S[j]));
            binomial = qdot_div(pool, qdot_mul(pool, binomial, qdot_expr_int(pool, i + 1 - j)),
                                qdot_expr_int(pool, j + 1));
        }
        S[i] = qdot_div(pool, sum, qdot_expr_int(pool, i + 1));
    }
    return qdot_pool_check(pool);
}

static qdot_status
sum_of_power(range *r, int64_t p, qdot_expr *value)
{
    qdot_expr *S;
    qdot_status status;

    if (p < 0 || p > MOST_POWER)
        return fail_without_formula();
    S = qdot_malloc(2 * ((size_t)p + 1) * sizeof *S);
    if (S == NULL)
        return QDOT_ENOMEM;
    status = sums_of_powers(r, r->last, p, S);
    if (status == QDOT_OK)
        status = sums_of_powers(r, r->first - 1, p, S + p + 1);
    if (status == QDOT_OK)
        *value = qdot_sub(r->pool, S[p], S[2 * p + 1]);
    qdot_free(S);
    return status;
}

/* Sum base^exponent over k by the geometric series; base is free of k, the exponent linear in k. */
static qdot_status
sum_of_geometric(range *r, qdot_expr base, qdot_expr exponent, qdot_expr *value)
{
    qdot_pool *pool = r->pool;
    const qdot_expr zero = QDOT_ZERO, alpha = qdot_diff(pool, exponent, r->k),
                    beta = qdot_subs(pool, exponent, 1, &r->k, &zero);
    qdot_expr rho, sum;

    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_contains(pool, alpha, r->k))
        return fail_without_formula();
    rho = qdot_pow(pool, base, alpha);
    if (rho == QDOT_ONE)
        return fail_without_formula();
    sum = qdot_sub(pool, qdot_pow(pool, rho, qdot_expr_int(pool, r->first)),
                   qdot_pow(pool, rho, qdot_expr_int(pool, r->last + 1)));
    sum = qdot_div(pool, sum, qdot_sub(pool, QDOT_ONE, rho));
    *value = qdot_mul(pool, qdot_pow(pool, base, beta), sum);
    return qdot_pool_check(pool);
}

/* Sum one product over k: factors free of k, times a power of k, or a power whose exponent contains k. */
static qdot_status
sum_of_product(range *r, qdot_expr e, qdot_expr *value)
{
    qdot_pool *pool = r->pool;
    const bool product = qdot_expr_kind(pool, e) == QDOT_PROD;
    const uint32_t n = product ? qdot_expr_count(pool, e) : 3;
    qdot_expr outside = product ? qdot_expr_arg(pool, e, 0) : QDOT_ONE, base = QDOT_NIL,
              exponent = QDOT_ZERO, sum = QDOT_NIL;
    int64_t p = 0;

    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr b = product ? qdot_expr_arg(pool, e, i) : e,
                        q = product ? qdot_expr_arg(pool, e, i + 1) : QDOT_ONE;

        if (!qdot_expr_contains(pool, b, r->k) && !qdot_expr_contains(pool, q, r->k)) {
            outside = qdot_mul(pool, outside, qdot_pow(pool, b, q));
        } else if (b == r->k && qdot_expr_to_int(pool, q, &p) && p > 0) {
            ;
        } else if (qdot_expr_kind(pool, b) == QDOT_FUN &&
                   qdot_expr_node(pool, b)->op == QDOT_EXP && base == QDOT_NIL) {
            base = qdot_fun1(pool, QDOT_EXP, QDOT_ONE);
            exponent = qdot_mul(pool, qdot_expr_arg(pool, b, 0), q);
        } else if (!qdot_expr_contains(pool, b, r->k) && base == QDOT_NIL) {
            base = b;
            exponent = q;
        } else {
            return fail_without_formula();
        }
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (base != QDOT_NIL && p > 0)
        return fail_without_formula();
    if (base != QDOT_NIL)
        QDOT_TRY(sum_of_geometric(r, base, exponent, &sum));
    else
        QDOT_TRY(sum_of_power(r, p, &sum));
    *value = qdot_mul(pool, outside, sum);
    return qdot_pool_check(pool);
}

qdot_status
qdot_closed_sum(qdot_pool *pool, qdot_expr e, qdot_expr k, int64_t first, int64_t last,
                qdot_expr *value)
{
    range r = {.pool = pool, .k = k, .first = first, .last = last};

    e = qdot_expand(pool, e);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return sum_of_product(&r, e, value);
    QDOT_TRY(sum_of_product(&r, qdot_expr_arg(pool, e, 0), value));
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr one;

        QDOT_TRY(sum_of_product(&r, qdot_expr_arg(pool, e, i), &one));
        *value = qdot_add(pool, *value,
                          qdot_mul(pool, qdot_expr_arg(pool, e, i + 1), one));
    }
    return qdot_pool_check(pool);
}
