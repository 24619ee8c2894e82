/* expand.c -- multiplies out products of sums; collects powers of one symbol. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/pool.h"
#include "expr/tensor.h"
#include "expr/walk.h"

enum { MOST_TERMS = 1500000 }; /* the most products of two terms that one call may compute */

/* The number of terms of e as a sum; 1 if e is no sum. */
static uint32_t
count_terms(const qdot_pool *pool, qdot_expr e)
{
    const qdot_node *node = NODE(pool, e);

    return node->kind == QDOT_SUM ? (node->n - 1) / 2 + (ARGS(pool, e)[0] != QDOT_ZERO)
                                  : 1;
}

static qdot_expr
get_term(qdot_pool *pool, qdot_expr e, uint32_t i)
{
    uint32_t terms;

    if (NODE(pool, e)->kind != QDOT_SUM)
        return e;
    terms = (NODE(pool, e)->n - 1) / 2;
    if (i == terms)
        return ARGS(pool, e)[0];
    return qdot_mul(pool, ARGS(pool, e)[2 + 2 * i], ARGS(pool, e)[1 + 2 * i]);
}

/* Multiply two expanded expressions, and expand the product. */
static qdot_expr
multiply_expanded(qdot_pool *pool, qdot_expr a, qdot_expr b, uint64_t *work)
{
    uint32_t na, nb;
    qdot_vec(qdot_expr) terms = {0};
    qdot_expr result;

    if (a == QDOT_NIL || b == QDOT_NIL)
        return QDOT_NIL;
    na = count_terms(pool, a);
    nb = count_terms(pool, b);
    if (na == 1 && nb == 1)
        return qdot_mul(pool, a, b);
    *work += (uint64_t)na * nb;
    if (*work > MOST_TERMS)
        return qdot_pool_refuse(pool, QDOT_ELIMIT,
                                "expanding it takes more than %llu products of terms",
                                (unsigned long long)*work);
    for (uint32_t i = 0; i < na && !FAILED(pool); i++) {
        qdot_expr x = get_term(pool, a, i);

        for (uint32_t k = 0; k < nb && !FAILED(pool); k++)
            if (qdot_vec_push(&terms, qdot_mul(pool, x, get_term(pool, b, k))) != QDOT_OK)
                qdot_pool_fail(pool);
    }
    result = qdot_sum(pool, terms.n, terms.at);
    qdot_free(terms.at);
    return result;
}

/* Compute s^n, n >= 1, for an expanded sum s, by repeated squaring. */
static qdot_expr
expand_power(qdot_pool *pool, qdot_expr s, uint64_t n, uint64_t *work)
{
    qdot_expr result = QDOT_ONE;

    for (; n > 0 && !FAILED(pool); n >>= 1) {
        if (n & 1)
            result = multiply_expanded(pool, result, s, work);
        if (n > 1)
            s = multiply_expanded(pool, s, s, work);
    }
    return result;
}

/* Multiply out a coefficient times one sum: 2*(a + b) becomes 2*a + 2*b. */
static qdot_expr
expand_multiple(qdot_pool *pool, qdot_expr e, uint64_t *work)
{
    qdot_expr rest = qdot_expr_strip(pool, e);

    return rest == QDOT_NIL || NODE(pool, rest)->kind != QDOT_SUM
               ? e
               : multiply_expanded(pool, ARGS(pool, e)[0], rest, work);
}

/* The expanded form of a product whose factors have been expanded. */
static qdot_expr
expand_product(qdot_pool *pool, qdot_expr e, const qdot_walk *w, uint64_t *work)
{
    qdot_expr result = ARGS(pool, e)[0], below = QDOT_ONE;
    uint32_t n = NODE(pool, e)->n;

    for (uint32_t i = 1; i < n && !FAILED(pool); i += 2) {
        qdot_expr base = (qdot_expr)qdot_walk_get(w, ARGS(pool, e)[i]);
        qdot_expr exponent = (qdot_expr)qdot_walk_get(w, ARGS(pool, e)[i + 1]);
        int64_t k;

        if (base == QDOT_NIL || exponent == QDOT_NIL)
            return QDOT_NIL;
        if (!qdot_expr_to_int(pool, exponent, &k) || NODE(pool, base)->kind != QDOT_SUM)
            result = multiply_expanded(pool, result, qdot_pow(pool, base, exponent), work);
        else if (k > 0)
            result = multiply_expanded(pool, result, expand_power(pool, base, (uint64_t)k, work), work);
        else
            below = multiply_expanded(pool, below, expand_power(pool, base, -(uint64_t)k, work), work);
    }
    if (below == QDOT_ONE || below == QDOT_NIL)
        return below == QDOT_NIL ? QDOT_NIL : result;
    return multiply_expanded(pool, result, qdot_pow(pool, below, QDOT_MINUS_ONE), work);
}

qdot_expr
qdot_expand(qdot_pool *pool, qdot_expr e)
{
    qdot_walk w;
    qdot_vec(qdot_expr) args = {0};
    qdot_expr result = QDOT_NIL;
    uint64_t work = 0;

    if (e == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && !FAILED(pool); i++) {
        qdot_expr node = w.at[i];
        uint32_t n = NODE(pool, node)->n;

        if (NODE(pool, node)->kind == QDOT_PROD) {
            result = expand_product(pool, node, &w, &work);
        } else if (n > 0) {
            if (qdot_grow(&args.at, &args.capacity, n, sizeof *args.at) != QDOT_OK) {
                qdot_pool_fail(pool);
                break;
            }
            for (uint32_t k = 0; k < n; k++)
                args.at[k] = (qdot_expr)qdot_walk_get(&w, ARGS(pool, node)[k]);
            result = qdot_rebuild(pool, node, args.at);
            if (NODE(pool, node)->kind == QDOT_SUM && result != QDOT_NIL &&
                NODE(pool, result)->kind == QDOT_PROD)
                result = expand_multiple(pool, result, &work); /* only one term is left: expand its product with the sum */
        } else {
            result = node;
        }
        w.value[i] = result;
    }
    qdot_free(args.at);
    qdot_walk_end(&w);
    return FAILED(pool) ? QDOT_NIL : result;
}

/* --- collecting powers of a symbol ---------------------------------------------------------- */

struct group {
    qdot_expr power; /* the power of x as an expression: QDOT_ONE for x^0 */
    qdot_vec(qdot_expr) coefficients;
};

typedef qdot_vec(struct group) groups;

/* Split a term into coefficient * x^k: *power is x^k, the result the coefficient. */
static qdot_expr
split_power(qdot_pool *pool, qdot_expr term, qdot_expr x, qdot_expr *power)
{
    *power = QDOT_ONE;
    if (term == x) {
        *power = x;
        return QDOT_ONE;
    }
    if (NODE(pool, term)->kind != QDOT_PROD)
        return term;
    for (uint32_t i = 1; i < NODE(pool, term)->n; i += 2)
        if (ARGS(pool, term)[i] == x) {
            *power = qdot_pow(pool, x, ARGS(pool, term)[i + 1]);
            return qdot_div(pool, term, *power);
        }
    return term;
}

static void
add_to_group(qdot_pool *pool, groups *all, qdot_expr power, qdot_expr coefficient)
{
    size_t i = 0;

    while (i < all->n && all->at[i].power != power)
        i++;
    if (i == all->n && qdot_vec_push(all, ((struct group){.power = power})) != QDOT_OK) {
        qdot_pool_fail(pool);
        return;
    }
    if (qdot_vec_push(&all->at[i].coefficients, coefficient) != QDOT_OK)
        qdot_pool_fail(pool);
}

static void
gather_coefficients(qdot_pool *pool, qdot_expr e, qdot_expr x, groups *all)
{
    uint32_t n;

    if (e == QDOT_NIL)
        return;
    n = count_terms(pool, e);
    for (uint32_t i = 0; i < n && !FAILED(pool); i++) {
        qdot_expr power, rest = split_power(pool, get_term(pool, e, i), x, &power);

        add_to_group(pool, all, power, rest);
    }
}

static void
free_groups(groups *all)
{
    for (size_t i = 0; i < all->n; i++)
        qdot_free(all->at[i].coefficients.at);
    qdot_free(all->at);
}

static qdot_expr
collect_powers_in_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr x = *(qdot_expr *)user, result = QDOT_ZERO;
    groups all = {0};

    gather_coefficients(pool, qdot_expand(pool, e), x, &all);
    for (size_t i = 0; i < all.n; i++)
        result = qdot_add(pool, result,
                          qdot_mul(pool, all.at[i].power,
                                   qdot_sum(pool, all.at[i].coefficients.n,
                                            all.at[i].coefficients.at)));
    free_groups(&all);
    return FAILED(pool) ? QDOT_NIL : result;
}

qdot_expr
qdot_collect(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    return qdot_value_map(pool, e, collect_powers_in_scalar, &x);
}

/* Whether power is x^n with n = 0, 1, 2 ... (ONE: n = 0). */
static bool
is_whole_power(const qdot_pool *pool, qdot_expr power, qdot_expr x)
{
    int64_t n;

    return power == QDOT_ONE || power == x ||
           (NODE(pool, power)->kind == QDOT_PROD && ARGS(pool, power)[1] == x &&
            qdot_expr_to_int(pool, ARGS(pool, power)[2], &n) && n > 0);
}

qdot_expr
qdot_coefficient(qdot_pool *pool, qdot_expr e, qdot_expr x, int64_t n)
{
    groups all = {0};
    qdot_expr wanted = qdot_pow_int(pool, x, n), result = QDOT_ZERO;

    if (e == QDOT_NIL || wanted == QDOT_NIL)
        return QDOT_NIL;
    gather_coefficients(pool, qdot_expand(pool, e), x, &all);
    for (size_t i = 0; i < all.n; i++) {
        qdot_expr c = qdot_sum(pool, all.at[i].coefficients.n, all.at[i].coefficients.at);

        if (c == QDOT_NIL)
            break;
        if (qdot_expr_contains(pool, c, x) || !is_whole_power(pool, all.at[i].power, x))
            qdot_pool_refuse(pool, QDOT_EDOMAIN, "not a polynomial in this name");
        else if (all.at[i].power == wanted)
            result = c;
    }
    free_groups(&all);
    return FAILED(pool) ? QDOT_NIL : result;
}
