/* written.c -- conditions for roots of an equation in the form in which it was typed, before roots of products are split. */
#include "normal/solve/written.h"

#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/solve/solve-factors.h"

/* The index of a relation in a set; UINT32_MAX if it is not there. */
static uint32_t
find_relation(qdot_pool *pool, qdot_expr set, qdot_expr relation)
{
    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++)
        if (qdot_expr_arg(pool, set, i) == relation)
            return i;
    return UINT32_MAX;
}

qdot_expr
qdot_conditions_less(qdot_pool *pool, qdot_expr set, qdot_expr some)
{
    qdot_expr left = QDOT_NIL;

    if (some == QDOT_NIL || set == QDOT_FALSE)
        return set;
    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++)
        if (!qdot_list_has(pool, some, qdot_expr_arg(pool, set, i)))
            left = qdot_conditions_and(pool, left, qdot_expr_arg(pool, set, i));
    return left;
}

/* Whether q is positive and not an integer. */
static bool
is_root_exponent(const fmpq *q)
{
    return q != NULL && fmpq_sgn(q) > 0 && !fmpz_is_one(fmpq_denref(q));
}

qdot_status
qdot_written_add(qdot_pool *pool, qdot_expr base, qdot_expr exponent, qdot_written *w, qdot_expr *asked)
{
    qdot_expr whole = qdot_rel(pool, QDOT_LE, QDOT_ZERO, base), parts;

    parts = qdot_conditions_of_domain(pool, qdot_pow(pool, base, exponent), QDOT_NIL);
    parts = qdot_conditions_less(pool, parts, qdot_conditions_of_domain(pool, base, QDOT_NIL));
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_kind(pool, base) != QDOT_PROD || qdot_expr_count(pool, base) < 5 || parts == QDOT_NIL ||
        !is_root_exponent(qdot_expr_rational(pool, exponent)) || qdot_list_has(pool, parts, whole)) {
        *asked = qdot_conditions_all(pool, *asked, parts);
    } else {
        w->domain = qdot_conditions_and(pool, w->domain, whole);
        w->apart = qdot_conditions_all(pool, w->apart, parts);
    }
    return qdot_pool_check(pool);
}

/* A sum as the product of its factors if one that contains x is repeated; otherwise the sum. */
static qdot_expr
factor_if_repeated(qdot_pool *pool, qdot_expr sum, qdot_expr x)
{
    qdot_expr product = qdot_solve_product(pool, sum);
    uint32_t n = product != QDOT_NIL && qdot_expr_kind(pool, product) == QDOT_PROD ? qdot_expr_count(pool, product) : 0;
    bool repeated = false;

    for (uint32_t i = 1; i + 1 < n && n >= 5; i += 2) {
        int64_t power;

        repeated = repeated || (qdot_expr_to_int(pool, qdot_expr_arg(pool, product, i + 1), &power) && power > 1 &&
                                qdot_expr_contains(pool, qdot_expr_arg(pool, product, i), x));
    }
    return repeated ? product : sum;
}

/* State for splitting roots of sums with x, and the conditions that this needs. */
typedef struct {
    qdot_expr x;
    qdot_written *written;
    qdot_status status;
} sums;

/* Replace roots of sums with repeated factors, such as sqrt(a^2 b), by products of roots. */
static qdot_expr
split_roots_of_sums(qdot_pool *pool, qdot_expr product, void *user)
{
    sums *s = user;
    qdot_expr result = qdot_expr_arg(pool, product, 0);

    for (uint32_t i = 1; i < qdot_expr_count(pool, product); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, product, i), exponent = qdot_expr_arg(pool, product, i + 1), by = base;

        if (is_root_exponent(qdot_expr_rational(pool, exponent)) && qdot_expr_kind(pool, base) == QDOT_SUM &&
            qdot_expr_contains(pool, base, s->x))
            by = factor_if_repeated(pool, base, s->x);
        if (by != base && s->status == QDOT_OK) {
            qdot_written of_sum = {QDOT_NIL, QDOT_NIL};
            qdot_expr whole = QDOT_NIL; /* the argument of a power that is not split: f itself requires it to be >= 0 */

            s->status = qdot_written_add(pool, by, exponent, &of_sum, &whole);
            of_sum.apart = qdot_conditions_less(pool, of_sum.apart, s->written->domain);
            s->written->apart = qdot_conditions_all(pool, s->written->apart, of_sum.apart);
        }
        result = qdot_mul(pool, result, qdot_pow(pool, by, exponent));
    }
    return result;
}

qdot_status
qdot_written_take_apart(qdot_pool *pool, qdot_expr *f, qdot_expr x, qdot_written *w)
{
    sums s = {x, w, QDOT_OK};

    *f = qdot_walk_replace(pool, *f, QDOT_PROD, split_roots_of_sums, &s);
    return s.status == QDOT_OK ? qdot_pool_check(pool) : s.status;
}

/* The symbol that stands for the expression g of condition number k, 0 <= g, in the set `apart`. */
static qdot_expr
symbol_of_condition(qdot_pool *pool, uint32_t k)
{
    char name[40];

    snprintf(name, sizeof name, "(part of a root %u)", (unsigned)k);
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

/* A product with a formal symbol in the place of each base of a root, one for each, that is >= 0 by a condition of
 * `user`, a list. */
static qdot_expr
replace_bases_of_roots(qdot_pool *pool, qdot_expr product, void *user)
{
    const qdot_expr apart = *(qdot_expr *)user;
    qdot_expr result = qdot_expr_arg(pool, product, 0);

    for (uint32_t i = 1; i < qdot_expr_count(pool, product); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, product, i), exponent = qdot_expr_arg(pool, product, i + 1);
        uint32_t k = is_root_exponent(qdot_expr_rational(pool, exponent)) &&
                             (qdot_expr_node(pool, base)->sign & QDOT_GE0) == 0
                         ? find_relation(pool, apart, qdot_rel(pool, QDOT_LE, QDOT_ZERO, base))
                         : UINT32_MAX;

        if (k != UINT32_MAX)
            base = symbol_of_condition(pool, k);
        result = qdot_mul(pool, result, qdot_pow(pool, base, exponent));
    }
    return result;
}

qdot_status
qdot_written_lifts(qdot_pool *pool, const qdot_written *w, qdot_expr f, qdot_expr x, qdot_expr value,
                   const qdot_facts *facts, bool *yes)
{
    qdot_expr apart = w->apart, there;
    qdot_status status;

    *yes = false;
    if (apart == QDOT_NIL || apart == QDOT_FALSE || value == x)
        return QDOT_OK;
    there = qdot_walk_replace(pool, f, QDOT_PROD, replace_bases_of_roots, &apart);
    there = there == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, there, 1, &x, &value);
    status = qdot_pool_check(pool);
    if (status != QDOT_OK)
        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    *yes = qdot_is_zero(pool, there, facts);
    return qdot_pool_check(pool);
}

/* Find the relation at x = value if it then contains no split root; nil if it does, or if it contained none before. */
static qdot_status
relation_without_roots(qdot_pool *pool, qdot_expr relation, qdot_expr apart, qdot_expr x, qdot_expr value, qdot_expr *there)
{
    qdot_expr by = qdot_walk_replace(pool, relation, QDOT_PROD, replace_bases_of_roots, &apart);
    qdot_status status;

    *there = by == relation || by == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, by, 1, &x, &value);
    status = qdot_pool_check(pool);
    for (uint32_t k = 0; *there != QDOT_NIL && k < qdot_expr_count(pool, apart); k++)
        if (qdot_expr_contains(pool, *there, symbol_of_condition(pool, k)))
            *there = QDOT_NIL;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

qdot_status
qdot_written_conditions(qdot_pool *pool, const qdot_written *w, qdot_expr x, qdot_expr value, qdot_expr *when)
{
    qdot_expr set = qdot_conditions_less(pool, *when, w->apart), left = QDOT_NIL;

    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && i < qdot_expr_count(pool, set); i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i), there;

        QDOT_TRY(relation_without_roots(pool, one, w->apart, x, value, &there));
        left = qdot_conditions_and(pool, left, there != QDOT_NIL ? there : one);
    }
    *when = set == QDOT_FALSE ? set : left;
    return qdot_pool_check(pool);
}
