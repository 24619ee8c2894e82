/* product.c -- makes products and powers; a product is a map from bases to exponents, with a
 * rational coefficient. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

#include <stdlib.h>
#include <string.h>

#include <flint/fmpz.h>

/* A factor base^exponent of a product. settled: it is canonical by itself, though another factor may have the same base. */
struct pair {
    qdot_expr base, exponent;
    bool settled;
};

struct product {
    qdot_pool *pool;
    fmpq c;
    struct pair few[16], *at;
    size_t n, capacity;
    bool failed;
};

static void
begin_product(struct product *p, qdot_pool *pool)
{
    p->pool = pool;
    fmpq_init(&p->c);
    fmpq_one(&p->c);
    p->at = p->few;
    p->n = 0;
    p->capacity = sizeof p->few / sizeof *p->few;
    p->failed = false;
}

static void
free_product(struct product *p)
{
    fmpq_clear(&p->c);
    if (p->at != p->few)
        qdot_free(p->at);
}

static void
push_factor(struct product *p, qdot_expr base, qdot_expr exponent)
{
    if (base == QDOT_NIL || exponent == QDOT_NIL) {
        p->failed = true;
        return;
    }
    if (p->n == p->capacity) {
        struct pair *bigger = p->at == p->few ? NULL : p->at;
        size_t capacity = p->at == p->few ? 0 : p->capacity;

        if (qdot_grow(&bigger, &capacity, p->n * 2, sizeof *bigger) != QDOT_OK) {
            qdot_pool_fail(p->pool);
            p->failed = true;
            return;
        }
        if (p->at == p->few)
            for (size_t i = 0; i < p->n; i++)
                bigger[i] = p->few[i];
        p->at = bigger;
        p->capacity = capacity;
    }
    p->at[p->n++] = (struct pair){base, exponent, false};
}

static void
multiply_by_number(struct product *p, const fmpq *c)
{
    if (fmpq_is_one(c))
        return;
    qdot_rational_mul(&p->c, &p->c, c);
    if (qdot_number_too_large(p->pool, &p->c))
        p->failed = true;
}

/* Multiply p by base^exponent, where the base is a number. */
static void
push_power_of_number(struct product *p, qdot_expr base, qdot_expr exponent)
{
    qdot_pool *pool = p->pool;
    const fmpq *e = NUMBER(pool, exponent);
    fmpq_t b, k, y;
    bool good = true;

    if (e == NULL) {
        if (base != QDOT_ONE)
            push_factor(p, base, exponent);
        return;
    }
    if (base == QDOT_ZERO && qdot_rational_sgn(e) < 0) {
        qdot_pool_refuse(pool, QDOT_EDOMAIN, "division by zero");
        p->failed = true;
        return;
    }
    if (base == QDOT_ZERO || base == QDOT_ONE || exponent == QDOT_ONE) {
        multiply_by_number(p, RATIONAL(pool, base));
        return;
    }
    fmpq_init(b);
    fmpq_init(k);
    fmpq_init(y);
    qdot_rational_set(b, RATIONAL(pool, base));
    qdot_rational_set(k, e);
    if (fmpz_is_one(fmpq_denref(k))) {
        good = qdot_number_power(pool, y, b, fmpq_numref(k));
    } else {
        good = qdot_number_root(pool, b, k, y, &base, &exponent);
        if (good && base != QDOT_ONE) {
            push_factor(p, base, exponent);
            if (!p->failed)
                p->at[p->n - 1].settled = true;
        }
    }
    if (good)
        multiply_by_number(p, y);
    else
        p->failed = true;
    fmpq_clear(b);
    fmpq_clear(k);
    fmpq_clear(y);
}

/* --- powers of products ------------------------------------------------------------------ */

static bool
is_integer(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = NUMBER(pool, e);

    return e == QDOT_ONE || (x != NULL && fmpz_is_one(fmpq_denref(x)));
}

static bool
is_even_integer(const qdot_pool *pool, qdot_expr e)
{
    return is_integer(pool, e) && fmpz_is_even(fmpq_numref(RATIONAL(pool, e)));
}

static bool
is_fraction(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = NUMBER(pool, e);

    return x != NULL && !fmpz_is_one(fmpq_denref(x));
}

/* (c b1^e1 ...)^k, k not an integer: what is known to be positive comes out, even powers as
 * absolute values; the rest stays under the root. */
static void
push_power_of_product(struct product *p, qdot_expr base, qdot_expr k)
{
    qdot_pool *pool = p->pool;
    uint32_t n = NODE(pool, base)->n;
    struct product rest;
    fmpq_t c;

    fmpq_init(c);
    begin_product(&rest, pool);
    qdot_rational_set(c, RATIONAL(pool, ARGS(pool, base)[0]));
    if (qdot_rational_sgn(c) < 0) {
        fmpq_neg(c, c);
        fmpq_neg(&rest.c, &rest.c);
    }
    if (!fmpq_is_one(c))
        push_power_of_number(p, qdot_expr_fmpq(pool, c), k);
    for (uint32_t i = 1; i < n && !p->failed; i += 2) {
        qdot_expr b = ARGS(pool, base)[i], e = ARGS(pool, base)[i + 1];

        /* x^(1/2) is real only where x >= 0 */
        if ((NODE(pool, b)->sign & QDOT_GE0) || is_fraction(pool, e))
            push_factor(p, b, qdot_mul(pool, e, k));
        else if (is_even_integer(pool, e))
            push_factor(p, qdot_fun1(pool, QDOT_ABS, b), qdot_mul(pool, e, k));
        else
            push_factor(&rest, b, e);
    }
    if (rest.n > 0 || !fmpq_is_one(&rest.c)) {
        if (rest.n == (n - 1) / 2 &&
            qdot_rational_equal(&rest.c, RATIONAL(pool, ARGS(pool, base)[0]))) {
            push_factor(p, base, k); /* no factor could be taken out of the root */
        } else if (rest.n == 0 && !(NODE(pool, base)->sign & QDOT_NE0)) {
            p->n = 0; /* sqrt(-x^2) is real only at x = 0: take nothing out of the root */
            fmpq_one(&p->c);
            push_factor(p, base, k);
        } else {
            qdot_expr f = qdot_expr_fmpq(pool, &rest.c);

            for (size_t i = 0; i < rest.n; i++)
                f = qdot_mul(pool, f,
                             qdot_pow(pool, rest.at[i].base, rest.at[i].exponent));
            if (f != QDOT_NIL && NODE(pool, f)->kind == QDOT_NUM)
                push_power_of_number(p, f, k);
            else
                push_factor(p, f, k);
        }
    }
    fmpq_clear(c);
    free_product(&rest);
}

/* --- the canonical form ------------------------------------------------------------------ */

/* Append the pairs (base, exponent) of a product, except the pair whose base has the index
 * `without` (0: all). */
static void
push_factors_of(struct product *p, qdot_expr e, uint32_t without)
{
    qdot_pool *pool = p->pool;

    for (uint32_t i = 1; i < NODE(pool, e)->n && !p->failed; i += 2)
        if (i != without) {
            push_factor(p, ARGS(pool, e)[i], ARGS(pool, e)[i + 1]);
            if (!p->failed)
                p->at[p->n - 1].settled = true;
        }
}

static void
product_multiply(struct product *p, qdot_expr e)
{
    qdot_pool *pool = p->pool;

    switch (NODE(pool, e)->kind) {
    case QDOT_NUM: multiply_by_number(p, RATIONAL(pool, e)); return;
    case QDOT_PROD:
        if (ARGS(pool, e)[0] != QDOT_ONE)
            multiply_by_number(p, RATIONAL(pool, ARGS(pool, e)[0]));
        push_factors_of(p, e, 0);
        return;
    default: push_factor(p, e, QDOT_ONE);
    }
}

static int
compare_base_ids(const void *a, const void *b)
{
    const struct pair *x = a, *y = b;

    return x->base < y->base ? -1 : x->base > y->base;
}

static int
compare_pairs(const void *a, const void *b, void *pool)
{
    const struct pair *x = a, *y = b;
    int d = qdot_expr_compare(pool, x->base, y->base);

    return d != 0 ? d : qdot_expr_compare(pool, x->exponent, y->exponent);
}

/* Sort the factors of the product, by node ids or in canonical order; by insertion if there are few. */
static void
sort_factors(struct product *p, bool ids)
{
    if (p->n > 16) {
        if (ids)
            qsort(p->at, p->n, sizeof *p->at, compare_base_ids);
        else
            qsort_r(p->at, p->n, sizeof *p->at, compare_pairs, p->pool);
        return;
    }
    for (size_t i = 1; i < p->n; i++) {
        struct pair x = p->at[i];
        size_t k = i;

        for (; k > 0 && (ids ? p->at[k - 1].base > x.base
                             : compare_pairs(&p->at[k - 1], &x, p->pool) > 0);
             k--)
            p->at[k] = p->at[k - 1];
        p->at[k] = x;
    }
}

/* Merge a product exp(a)^i exp(b)^j ... into one exponential. Returns whether there was something to merge. */
static bool
merge_exponentials(struct product *p)
{
    qdot_pool *pool = p->pool;
    size_t count = 0, kept = 0;
    bool plain = true;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < p->n; i++)
        if (NODE(pool, p->at[i].base)->kind == QDOT_FUN &&
            NODE(pool, p->at[i].base)->op == QDOT_EXP) {
            count++;
            plain &= p->at[i].exponent == QDOT_ONE;
        }
    if (count == 0 || (count == 1 && plain))
        return false;
    for (size_t i = 0; i < p->n; i++) {
        const qdot_node *node = NODE(pool, p->at[i].base);

        if (node->kind == QDOT_FUN && node->op == QDOT_EXP)
            sum =
                qdot_add(pool, sum,
                         qdot_mul(pool, ARGS(pool, p->at[i].base)[0], p->at[i].exponent));
        else
            p->at[kept++] = p->at[i];
    }
    p->n = kept;
    if (sum == QDOT_NIL)
        p->failed = true;
    else
        product_multiply(p, qdot_fun1(pool, QDOT_EXP, sum));
    return true;
}

static bool
is_number_root(const qdot_pool *pool, const struct pair *x)
{
    return NODE(pool, x->base)->kind == QDOT_NUM &&
           NODE(pool, x->exponent)->kind == QDOT_NUM;
}

/* Merge roots of numbers with the same exponent: sqrt(2)*sqrt(6) is 2*sqrt(3). */
static bool
merge_roots(struct product *p)
{
    qdot_pool *pool = p->pool;

    for (size_t i = 0; i < p->n; i++)
        for (size_t j = i + 1; j < p->n && is_number_root(pool, &p->at[i]); j++)
            if (p->at[i].exponent == p->at[j].exponent &&
                is_number_root(pool, &p->at[j])) {
                qdot_expr e = p->at[i].exponent;
                qdot_expr b = qdot_mul(pool, p->at[i].base, p->at[j].base);

                p->at[j] = p->at[--p->n];
                p->at[i] = p->at[--p->n];
                if (b == QDOT_NIL)
                    p->failed = true;
                else
                    push_power_of_number(p, b, e);
                return true;
            }
    return false;
}

/* Merge powers of a sum and of its negative: sqrt(b - a) (a - b)^n is (-1)^n (b - a)^(n + 1/2). */
static bool
merge_opposite_sums(struct product *p)
{
    qdot_pool *pool = p->pool;

    for (size_t i = 0; i < p->n; i++) {
        struct pair *x = &p->at[i];
        qdot_expr other;

        if (NODE(pool, x->base)->kind != QDOT_SUM || is_integer(pool, x->exponent) ||
            !qdot_expr_is_negative(pool, x->base))
            continue;
        other = qdot_sum_turned(pool, x->base);
        for (size_t j = 0; j < p->n; j++)
            if (p->at[j].base == other && is_integer(pool, p->at[j].exponent)) {
                if (!is_even_integer(pool, p->at[j].exponent))
                    fmpq_neg(&p->c, &p->c);
                x->exponent = qdot_add(pool, x->exponent, p->at[j].exponent);
                p->failed = x->exponent == QDOT_NIL;
                p->at[j] = p->at[--p->n];
                return true;
            }
    }
    return false;
}

/* Remove a factor sign(u) from the product; returns whether there was one. */
static bool
remove_sign_factor(struct product *p, size_t n, qdot_expr u)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_node *base = NODE(p->pool, p->at[i].base);

        if (base->kind == QDOT_FUN && base->op == QDOT_SIGN &&
            ARGS(p->pool, p->at[i].base)[0] == u && p->at[i].exponent == QDOT_ONE) {
            p->at[i].exponent = QDOT_ZERO;
            return true;
        }
    }
    return false;
}

/* Merge equal bases, then rewrite each pair that is not canonical. Returns whether the list
 * changed in a way that asks for another round. */
static bool
run_merging_round(struct product *p)
{
    qdot_pool *pool = p->pool;
    size_t kept = 0, n;
    bool again = false;

    sort_factors(p, true);
    for (size_t i = 0; i < p->n; i++) {
        if (kept > 0 && p->at[kept - 1].base == p->at[i].base) {
            qdot_expr e = qdot_add(pool, p->at[kept - 1].exponent, p->at[i].exponent);

            if (e == QDOT_NIL) {
                p->failed = true;
                return false;
            }
            p->at[kept - 1].exponent = e;
            p->at[kept - 1].settled = false;
        } else {
            p->at[kept++] = p->at[i];
        }
    }
    n = kept;
    kept = 0;
    for (size_t i = 0; i < n && !p->failed; i++) {
        struct pair x = p->at[i];
        const qdot_node *base = NODE(pool, x.base);

        if (x.exponent == QDOT_ZERO)
            continue;
        if (base->kind == QDOT_PROD && is_integer(pool, x.exponent)) {
            /* append the factors of this product after the part of the list that is not processed yet */
            qdot_expr e = x.base;
            fmpq_t y;

            fmpq_init(y);
            if (qdot_number_power(pool, y, RATIONAL(pool, ARGS(pool, e)[0]),
                                  fmpq_numref(RATIONAL(pool, x.exponent))))
                multiply_by_number(p, y);
            else
                p->failed = true;
            fmpq_clear(y);
            p->n = n;
            for (uint32_t k = 1; k < NODE(pool, e)->n && !p->failed; k += 2) {
                qdot_expr inner = qdot_mul(pool, ARGS(pool, e)[k + 1], x.exponent);

                push_factor(p, ARGS(pool, e)[k], inner);
            }
            n = p->n;
            again = true;
        } else if (base->kind == QDOT_FUN && base->op == QDOT_ABS &&
                   is_even_integer(pool, x.exponent)) {
            qdot_expr arg = ARGS(pool, x.base)[0];

            p->n = n;
            push_factor(p, arg, x.exponent);
            n = p->n;
            again = true;
        } else if (base->kind == QDOT_FUN && base->op == QDOT_ABS &&
                   is_integer(pool, x.exponent) &&
                   qdot_rational_sgn(RATIONAL(pool, x.exponent)) > 0 &&
                   remove_sign_factor(p, n, ARGS(pool, x.base)[0])) {
            qdot_expr arg = ARGS(pool, x.base)[0]; /* |u| sign(u) = u */

            p->n = n;
            push_factor(p, arg, x.exponent);
            n = p->n;
            again = true;
        } else if (base->kind == QDOT_SUM && is_integer(pool, x.exponent) &&
                   qdot_expr_is_negative(pool, x.base)) {
            /* replace (b - a)^n by (a - b)^n with a sign, so that both forms combine */
            p->n = n;
            push_factor(p, qdot_sum_turned(pool, x.base), x.exponent);
            n = p->n;
            if (!is_even_integer(pool, x.exponent))
                fmpq_neg(&p->c, &p->c);
            again = true;
        } else if (base->kind == QDOT_NUM &&
                   NUMBER(pool, x.exponent) != NULL) {
            if (x.settled) {
                p->at[kept++] = x;
            } else {
                p->n = n;
                push_power_of_number(p, x.base, x.exponent);
                again |= p->n > n;
                n = p->n;
            }
        } else {
            p->at[kept++] = x;
        }
    }
    p->n = kept;
    return again;
}

/* Whether nothing but merging and sorting is to be done to a pair: an integer power of what no
 * other factor can change but its like. */
static bool
needs_only_merging(const qdot_pool *pool, const struct pair *x)
{
    const qdot_node *base = NODE(pool, x->base);

    if (!is_integer(pool, x->exponent))
        return false;
    switch (base->kind) {
    case QDOT_SYM:
    case QDOT_INTEGRAL:
    case QDOT_UFUN: return true;
    case QDOT_FUN: return base->op != QDOT_EXP && base->op != QDOT_ABS;
    case QDOT_SUM: return !qdot_expr_is_negative(pool, x->base);
    default: return false;
    }
}

static bool
all_need_only_merging(const struct product *p)
{
    for (size_t i = 0; i < p->n; i++)
        if (!needs_only_merging(p->pool, &p->at[i]))
            return false;
    return p->n <= 16;
}

/* Sort the pairs (base, exponent), and combine pairs with equal bases. The factors of each product are already sorted. */
static void
product_combine_equal_bases(struct product *p)
{
    qdot_pool *pool = p->pool;
    size_t kept = 0;

    for (size_t i = 0; i < p->n && !p->failed; i++) {
        struct pair x = p->at[i], *at = p->at;
        size_t k = kept;

        while (k > 0 && at[k - 1].base != x.base &&
               qdot_expr_compare(pool, at[k - 1].base, x.base) > 0)
            k--;
        if (k > 0 && at[k - 1].base == x.base) {
            at[k - 1].exponent = qdot_add(pool, at[k - 1].exponent, x.exponent);
            p->failed = at[k - 1].exponent == QDOT_NIL;
            if (at[k - 1].exponent == QDOT_ZERO)
                memmove(&at[k - 1], &at[k], (kept-- - k) * sizeof *at);
            continue;
        }
        memmove(&at[k + 1], &at[k], (kept++ - k) * sizeof *at);
        at[k] = x;
    }
    p->n = kept;
}

/* Whether the list of factors may contain something that is not canonical yet. */
static bool
may_be_uncanonical(const struct product *p)
{
    qdot_kind kind = p->n == 0 ? QDOT_SYM : NODE(p->pool, p->at[0].base)->kind;

    return p->n > 1 || (p->n == 1 && (p->at[0].exponent != QDOT_ONE || kind == QDOT_NUM ||
                                      kind == QDOT_PROD || kind == QDOT_SUM));
}

static qdot_expr
make_product_node(struct product *p)
{
    qdot_pool *pool = p->pool;
    qdot_expr few[33], *args = few, e = QDOT_NIL;
    bool again = true, plain = all_need_only_merging(p);

    if (plain)
        product_combine_equal_bases(p);
    for (int round = 0; !plain && again && !p->failed && round < 64 && may_be_uncanonical(p); round++) {
        again = run_merging_round(p);
        again |= !p->failed && merge_exponentials(p);
        again |= !p->failed && merge_roots(p);
        again |= !p->failed && merge_opposite_sums(p);
    }
    if (p->failed || FAILED(pool))
        return QDOT_NIL;
    if (fmpq_is_zero(&p->c))
        return QDOT_ZERO;
    if (p->n == 0)
        return qdot_expr_fmpq(pool, &p->c);
    if (p->n == 1 && p->at[0].exponent == QDOT_ONE && fmpq_is_one(&p->c))
        return p->at[0].base;
    if (p->n == 1 && p->at[0].exponent == QDOT_ONE &&
        qdot_integer_is(fmpq_numref(&p->c), -1) && fmpz_is_one(fmpq_denref(&p->c)) &&
        NODE(pool, p->at[0].base)->kind == QDOT_SUM)
        return qdot_sum_turned(pool, p->at[0].base);
    if (!plain)
        sort_factors(p, false);
    if (p->n > 16 && (args = qdot_malloc((2 * p->n + 1) * sizeof *args)) == NULL)
        return qdot_pool_fail(pool);
    args[0] = fmpq_is_one(&p->c) ? QDOT_ONE : qdot_expr_fmpq(pool, &p->c);
    for (size_t i = 0; i < p->n; i++) {
        args[1 + 2 * i] = p->at[i].base;
        args[2 + 2 * i] = p->at[i].exponent;
    }
    if (!FAILED(pool)) {
        uint32_t n = (uint32_t)(2 * p->n + 1);

        e = qdot_pool_intern(pool, QDOT_PROD, 0, n, args,
                             qdot_sign_of_product(pool, n, args));
    }
    if (args != few)
        qdot_free(args);
    return e;
}

/* --- making products and powers ---------------------------------------------------------- */

qdot_expr
qdot_product(qdot_pool *pool, size_t n, const qdot_expr *factors)
{
    struct product p;
    qdot_expr e = QDOT_NIL;

    for (size_t i = 0; i < n; i++) {
        if (factors[i] == QDOT_NIL)
            return QDOT_NIL;
        if (!qdot_pool_is_scalar(pool, factors[i]))
            return qdot_pool_refuse(pool, QDOT_ETYPE, "a number is needed here");
    }
    if (FAILED(pool))
        return QDOT_NIL;
    begin_product(&p, pool);
    for (size_t i = 0; i < n && !p.failed; i++)
        product_multiply(&p, factors[i]);
    e = make_product_node(&p);
    free_product(&p);
    return e;
}

qdot_expr
qdot_product_derived(qdot_pool *pool, qdot_expr e, uint32_t i, qdot_expr inner)
{
    struct product p;
    qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1], result;

    if (inner == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    begin_product(&p, pool);
    qdot_rational_set(&p.c, RATIONAL(pool, ARGS(pool, e)[0]));
    push_factors_of(&p, e, i);
    if (x != QDOT_ONE) {
        qdot_expr less = qdot_sub(pool, x, QDOT_ONE);

        if (NODE(pool, b)->kind == QDOT_NUM && less != QDOT_NIL)
            push_power_of_number(&p, b, less);
        else
            push_factor(&p, b, less);
        if (!p.failed)
            product_multiply(&p, x);
    }
    if (!p.failed)
        product_multiply(&p, inner);
    result = make_product_node(&p);
    free_product(&p);
    return result;
}

qdot_expr
qdot_pow(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    struct product p;
    qdot_expr e;
    uint32_t kind;

    if (a == QDOT_NIL || b == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (!qdot_pool_is_scalar(pool, a) || !qdot_pool_is_scalar(pool, b))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a number is needed in a power");
    if (b == QDOT_ONE)
        return a;
    if (b == QDOT_ZERO)
        return QDOT_ONE;
    if (a == QDOT_ZERO && (NODE(pool, b)->sign & QDOT_POS) == QDOT_POS)
        return QDOT_ZERO;
    if (qdot_expr_is_atom(pool, a)) {
        qdot_expr args[] = {QDOT_ONE, a, b};

        return qdot_pool_intern(pool, QDOT_PROD, 0, 3, args,
                                qdot_sign_of_product(pool, 3, args));
    }
    begin_product(&p, pool);
    kind = NODE(pool, a)->kind;
    if (kind == QDOT_NUM)
        push_power_of_number(&p, a, b);
    else if (kind == QDOT_PROD && !is_integer(pool, b))
        push_power_of_product(&p, a, b);
    else
        push_factor(&p, a, b);
    e = make_product_node(&p);
    free_product(&p);
    return e;
}
