/* expand.c -- multiplies out products of sums; collects powers of one symbol.
 *
 * Small products are multiplied term by term. What takes more work than that is put off, as an item of a list
 * (multiply.h), and with it the sums and products that hold it, until an expression is needed: an argument of a function,
 * a base under a root or below a fraction bar, the result.
 */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/polynomial/flint.h"
#include "expr/polynomial/multiply.h"
#include "expr/pool.h"
#include "expr/tensor.h"
#include "expr/walk.h"

/* The work, in terms that come out of a power, up to which multiplying expressions is faster than FLINT with its thread; and
 * where that is not yet loaded (5 ms). A product of terms counts less, for of products fewer terms are alike than of powers. */
#define SMALL 100
#define SMALL_AT_FIRST 10000
#define PRODUCT 0.25

/* In the values of a walk: the index of an item, for a node whose expression is put off. */
#define PUT_OFF (UINT64_C(1) << 63)

typedef struct {
    qdot_pool *pool;
    qdot_walk w;
    qdot_multiply_list list;
} expansion;

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

/* --- term by term ------------------------------------------------------------------------- */

/* Multiply two expanded expressions, and expand the product. */
static qdot_expr
multiply_expanded(qdot_pool *pool, qdot_expr a, qdot_expr b)
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
expand_power(qdot_pool *pool, qdot_expr s, uint64_t n)
{
    qdot_expr result = QDOT_ONE;

    for (; n > 0 && !FAILED(pool); n >>= 1) {
        if (n & 1)
            result = multiply_expanded(pool, result, s);
        if (n > 1)
            s = multiply_expanded(pool, s, s);
    }
    return result;
}

/* --- items that are put off ----------------------------------------------------------------- */

static bool
is_put_off(uint64_t value)
{
    return (value & PUT_OFF) != 0;
}

/* The most terms that a value has. */
static double
bound_terms(const expansion *x, uint64_t value)
{
    return is_put_off(value) ? x->list.items.at[value & ~PUT_OFF].terms : count_terms(x->pool, (qdot_expr)value);
}

/* Append a part to the item that is being made. */
static void
item_add_part(expansion *x, uint64_t value, qdot_expr c, uint64_t power)
{
    const bool item = is_put_off(value);

    if (qdot_vec_push(&x->list.parts, ((qdot_multiply_part){item ? QDOT_NIL : (qdot_expr)value,
                                                            item ? (uint32_t)(value & ~PUT_OFF) : 0, c, power})) != QDOT_OK)
        qdot_pool_fail(x->pool);
}

/* Make an item of the parts from index `from` on. */
static uint64_t
put_off(expansion *x, bool is_sum, qdot_expr c, size_t from, double terms)
{
    if (FAILED(x->pool) ||
        qdot_vec_push(&x->list.items, ((qdot_multiply_item){is_sum, c, from, x->list.parts.n - from, terms})) != QDOT_OK) {
        qdot_pool_fail(x->pool);
        return QDOT_NIL;
    }
    return PUT_OFF | (x->list.items.n - 1);
}

/* The expression of a value. */
static qdot_expr
value_expr(expansion *x, uint64_t value)
{
    return is_put_off(value) ? qdot_multiply_out(x->pool, &x->list, (uint32_t)(value & ~PUT_OFF)) : (qdot_expr)value;
}

/* The same of a node of the walk, which keeps it. */
static qdot_expr
node_expr(expansion *x, qdot_expr node)
{
    const uint64_t value = qdot_walk_get(&x->w, node);
    qdot_expr e;

    if (!is_put_off(value))
        return (qdot_expr)value;
    e = value_expr(x, value);
    qdot_walk_set(&x->w, node, e);
    return e;
}

/* A sum of which some terms are put off; the others are one part. */
static uint64_t
put_off_sum(expansion *x, qdot_expr node)
{
    qdot_pool *pool = x->pool;
    const uint32_t n = NODE(pool, node)->n;
    const size_t from = x->list.parts.n;
    qdot_vec(qdot_expr) others = {0};
    qdot_expr rest;
    double terms = 0;

    for (uint32_t i = 1; i < n && !FAILED(pool); i += 2) {
        const uint64_t value = qdot_walk_get(&x->w, ARGS(pool, node)[i]);
        const qdot_expr c = ARGS(pool, node)[i + 1];

        if (is_put_off(value)) {
            item_add_part(x, value, c, 1);
            terms += bound_terms(x, value);
        } else if (qdot_vec_push(&others, qdot_mul(pool, c, (qdot_expr)value)) != QDOT_OK) {
            qdot_pool_fail(pool);
        }
    }
    rest = qdot_sum(pool, others.n, others.at);
    qdot_free(others.at);
    if (rest == QDOT_NIL)
        return QDOT_NIL;
    item_add_part(x, rest, QDOT_ONE, 1);
    return put_off(x, true, ARGS(pool, node)[0], from, terms + count_terms(pool, rest));
}

/* --- products ------------------------------------------------------------------------------- */

/* A factor of a product: value^power, power >= 1. */
typedef struct {
    uint64_t value, power;
} factor;

/* The work of the n-th power of t terms by squaring: mostly that of the last square. */
static double
work_of_power(double t, uint64_t n)
{
    const double half = qdot_multiply_terms_of_power(t, n / 2);

    return n < 2 ? 0 : half * half;
}

/* The value of c times the factors. */
static uint64_t
multiply_factors(expansion *x, qdot_expr c, size_t n, const factor *factors)
{
    const size_t from = x->list.parts.n;
    double terms = 1, work = 0;
    bool small = true;
    uint32_t touches = 0; /* the symbols of the factors so far */
    qdot_expr result = c;

    for (size_t i = 0; i < n; i++) {
        const uint64_t value = factors[i].value, power = factors[i].power;
        const double t = bound_terms(x, value);

        if (is_put_off(value)) {
            terms *= qdot_multiply_terms_of_power(t, power);
            small = false;
            continue;
        }
        if (t > 1) {
            terms *= qdot_multiply_terms_of_power(t, power);
            work += work_of_power(t, power) + (touches & NODE(x->pool, value)->touches ? PRODUCT * terms : 0);
        }
        touches |= NODE(x->pool, value)->touches;
    }
    if (small && terms <= QDOT_MULTIPLY_MOST_TERMS && work <= (qdot_flint_is_ready() ? SMALL : SMALL_AT_FIRST)) {
        for (size_t i = 0; i < n; i++)
            result = multiply_expanded(x->pool, result,
                                       factors[i].power == 1
                                           ? (qdot_expr)factors[i].value
                                           : expand_power(x->pool, (qdot_expr)factors[i].value, factors[i].power));
        return result;
    }
    for (size_t i = 0; i < n; i++)
        item_add_part(x, factors[i].value, QDOT_ONE, factors[i].power);
    return put_off(x, false, c, from, terms);
}

/* The same of two as an expression. */
static qdot_expr
product_expr(expansion *x, factor a, factor b)
{
    const factor factors[] = {a, b};
    const uint64_t value = multiply_factors(x, QDOT_ONE, 2, factors);

    return FAILED(x->pool) ? QDOT_NIL : value_expr(x, value);
}

/* The value of a product whose factors have been expanded. */
static uint64_t
expand_product(expansion *x, qdot_expr e)
{
    qdot_pool *pool = x->pool;
    const uint32_t n = NODE(pool, e)->n;
    factor few[16], *factors = n <= 32 ? few : qdot_malloc(n * sizeof *factors);
    qdot_expr below = QDOT_ONE;
    size_t count = 0;
    uint64_t result = QDOT_NIL;

    if (factors == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 1; i < n && !FAILED(pool); i += 2) {
        const qdot_expr exponent = node_expr(x, ARGS(pool, e)[i + 1]);
        uint64_t base = qdot_walk_get(&x->w, ARGS(pool, e)[i]);
        int64_t k;

        if (exponent == QDOT_NIL || !qdot_expr_to_int(pool, exponent, &k))
            k = 0;
        if (k <= 0)
            base = node_expr(x, ARGS(pool, e)[i]);
        if (base == QDOT_NIL || exponent == QDOT_NIL)
            break;
        if (k > 0 && (is_put_off(base) || NODE(pool, base)->kind == QDOT_SUM))
            factors[count++] = (factor){base, (uint64_t)k};
        else if (k < 0 && NODE(pool, base)->kind == QDOT_SUM)
            below = product_expr(x, (factor){below, 1}, (factor){base, -(uint64_t)k});
        else
            factors[count++] = (factor){qdot_pow(pool, (qdot_expr)base, exponent), 1};
    }
    if (below != QDOT_ONE && !FAILED(pool))
        factors[count++] = (factor){qdot_pow(pool, below, QDOT_MINUS_ONE), 1};
    if (!FAILED(pool))
        result = multiply_factors(x, ARGS(pool, e)[0], count, factors);
    if (factors != few)
        qdot_free(factors);
    return FAILED(pool) ? QDOT_NIL : result;
}

/* Multiply out a coefficient times one sum: 2*(a + b) becomes 2*a + 2*b. */
static qdot_expr
expand_multiple(qdot_pool *pool, qdot_expr e)
{
    qdot_expr rest = qdot_expr_strip(pool, e);

    return rest == QDOT_NIL || NODE(pool, rest)->kind != QDOT_SUM
               ? e
               : multiply_expanded(pool, ARGS(pool, e)[0], rest);
}

/* Whether an argument of a node is put off. */
static bool
has_put_off(const expansion *x, qdot_expr node)
{
    for (uint32_t k = 0; x->list.items.n > 0 && k < NODE(x->pool, node)->n; k++)
        if (is_put_off(qdot_walk_get(&x->w, ARGS(x->pool, node)[k])))
            return true;
    return false;
}

/* Rebuild a node that is no product from its expanded arguments; args is work space. */
static qdot_expr
rebuild_node(expansion *x, qdot_expr node, qdot_expr *args)
{
    qdot_pool *pool = x->pool;
    qdot_expr result;

    for (uint32_t k = 0; k < NODE(pool, node)->n && !FAILED(pool); k++)
        args[k] = node_expr(x, ARGS(pool, node)[k]);
    if (FAILED(pool))
        return QDOT_NIL;
    result = qdot_rebuild(pool, node, args);
    if (NODE(pool, node)->kind == QDOT_SUM && result != QDOT_NIL && NODE(pool, result)->kind == QDOT_PROD)
        result = expand_multiple(pool, result); /* only one term is left: expand its product with the sum */
    return result;
}

qdot_expr
qdot_expand(qdot_pool *pool, qdot_expr e)
{
    expansion x;
    qdot_vec(qdot_expr) args = {0};
    qdot_expr result = QDOT_NIL;

    if (e == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    x.pool = pool;
    x.list = (qdot_multiply_list){.items = {0}};
    if (qdot_walk_begin(pool, e, &x.w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < x.w.n && !FAILED(pool); i++) {
        const qdot_expr node = x.w.at[i];
        const uint32_t n = NODE(pool, node)->n;

        if (NODE(pool, node)->kind == QDOT_PROD)
            x.w.value[i] = expand_product(&x, node);
        else if (NODE(pool, node)->kind == QDOT_SUM && has_put_off(&x, node))
            x.w.value[i] = put_off_sum(&x, node);
        else if (n > 0 && qdot_grow(&args.at, &args.capacity, n, sizeof *args.at) != QDOT_OK)
            qdot_pool_fail(pool);
        else
            x.w.value[i] = n > 0 ? rebuild_node(&x, node, args.at) : node;
    }
    if (!FAILED(pool))
        result = node_expr(&x, e);
    qdot_free(args.at);
    qdot_free(x.list.items.at);
    qdot_free(x.list.parts.at);
    qdot_walk_end(&x.w);
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
