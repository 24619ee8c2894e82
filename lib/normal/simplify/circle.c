/* circle.c -- joins sin(u)^2 and cos(u)^2 where both have the same factor. */
#include "normal/simplify/circle.h"

#include <flint/fmpq.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"

enum { MOST_TERMS = 200 };

/* Whether factor k of the product `term` is sin(u)^n, n >= 2 an integer. */
static bool
is_sine_squared(const qdot_pool *pool, qdot_expr term, uint32_t k)
{
    const fmpq *n = qdot_expr_rational(pool, qdot_expr_arg(pool, term, k + 1));

    return qdot_expr_is_function(pool, qdot_expr_arg(pool, term, k), QDOT_SIN) && n != NULL &&
           fmpz_is_one(fmpq_denref(n)) && fmpz_cmp_ui(fmpq_numref(n), 2) >= 0;
}

/* The index of a term in a sum; 0: the sum does not contain the term. */
static uint32_t
find_term(const qdot_pool *pool, qdot_expr sum, qdot_expr term)
{
    for (uint32_t j = 1; j < qdot_expr_count(pool, sum); j += 2)
        if (qdot_expr_arg(pool, sum, j) == term)
            return j;
    return 0;
}

/* The part of c and d by which two terms are joined: both if they are equal, the smaller of two integers of one sign;
 * nil: none. */
static qdot_expr
common_coefficient(const qdot_pool *pool, qdot_expr c, qdot_expr d)
{
    const fmpq *x = qdot_expr_rational(pool, c), *y = qdot_expr_rational(pool, d);

    if (c == d)
        return c;
    if (!fmpz_is_one(fmpq_denref(x)) || !fmpz_is_one(fmpq_denref(y)) || fmpq_sgn(x) != fmpq_sgn(y))
        return QDOT_NIL;
    return fmpz_cmpabs(fmpq_numref(x), fmpq_numref(y)) < 0 ? c : d;
}

/* The sum with term i, whose factor k is sin(u)^n, joined with a term that has cos(u)^2 instead; nil: there is none. */
static qdot_expr
joined(qdot_pool *pool, qdot_expr sum, uint32_t i, uint32_t k)
{
    const qdot_expr term = qdot_expr_arg(pool, sum, i);
    const qdot_expr sine = qdot_expr_arg(pool, term, k), u = qdot_expr_arg(pool, sine, 0);
    const qdot_expr two = qdot_expr_int(pool, 2);
    const qdot_expr factor = qdot_div(pool, term, qdot_pow(pool, sine, two));
    const qdot_expr other =
        qdot_mul(pool, factor, qdot_pow(pool, qdot_fun(pool, QDOT_COS, 1, &u), two));
    const uint32_t j = find_term(pool, sum, other);
    const qdot_expr c =
        j > 0 ? common_coefficient(pool, qdot_expr_arg(pool, sum, i + 1), qdot_expr_arg(pool, sum, j + 1)) : QDOT_NIL;

    if (c == QDOT_NIL)
        return QDOT_NIL;
    sum = qdot_sub(pool, sum, qdot_mul(pool, c, qdot_add(pool, term, other)));
    return qdot_add(pool, sum, qdot_mul(pool, c, factor));
}

/* The sum with one pair of terms in sin(u)^2 and cos(u)^2 joined; the sum itself if there is no pair. */
static qdot_expr
join_pair(qdot_pool *pool, qdot_expr sum)
{
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2) {
        const qdot_expr term = qdot_expr_arg(pool, sum, i);

        for (uint32_t k = 1; qdot_expr_kind(pool, term) == QDOT_PROD && k < qdot_expr_count(pool, term); k += 2) {
            const qdot_expr one = is_sine_squared(pool, term, k) ? joined(pool, sum, i, k) : QDOT_NIL;

            if (one != QDOT_NIL)
                return one;
        }
    }
    return sum;
}

static qdot_expr
join_all_pairs(qdot_pool *pool, qdot_expr sum, void *user)
{
    qdot_expr before = QDOT_NIL;

    (void)user;
    while (sum != before && qdot_expr_kind(pool, sum) == QDOT_SUM && qdot_expr_count(pool, sum) <= 2 * MOST_TERMS) {
        before = sum;
        sum = join_pair(pool, before);
    }
    return sum;
}

qdot_expr
qdot_circle_join(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_SUM, join_all_pairs, NULL);
}
