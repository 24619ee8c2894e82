/* solve-factors.c -- writes an expression as a product. */
#include "normal/solve/solve-factors.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/flint.h"
#include "normal/field/prepare.h"
#include "normal/simplify/simplify.h"

enum { WORK = 2000000 };

/* Irreducible factors with their exponents times `turn`, and the content, to a product. */
static qdot_status
collect(qdot_field *f, const fmpz_mpoly_t p, long turn, qdot_expr *product,
        qdot_expr **list, size_t *n, size_t *capacity)
{
    qdot_pool *pool = f->pool;
    qdot_factors factors;
    qdot_status status = qdot_factor(f, &factors, p);
    fmpq_t content;

    fmpq_init(content);
    if (status == QDOT_OK) {
        fmpz_set(fmpq_numref(content), factors.content);
        *product = qdot_mul(pool, *product,
                            qdot_pow_int(pool, qdot_expr_fmpq(pool, content), turn));
    }
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++) {
        qdot_expr e = qdot_field_expr(f, factors.poly + i);

        *product = qdot_mul(pool, *product, qdot_pow_int(pool, e, turn * factors.exp[i]));
        if (list == NULL)
            continue;
        status = qdot_grow(list, capacity, *n + 1, sizeof **list);
        if (status == QDOT_OK)
            (*list)[(*n)++] = e;
    }
    fmpq_clear(content);
    qdot_factor_clear(f, &factors);
    return status;
}

/* The product, and the numerator's factors if asked for (*list stays NULL past the budget). */
static qdot_status
factors_of(qdot_pool *pool, qdot_expr e, qdot_expr *product, qdot_expr **list, size_t *n)
{
    qdot_expr prepared = qdot_prepare(pool, e);
    size_t capacity = 0;
    qdot_status status = qdot_pool_check(pool);
    qdot_field f;

    QDOT_TRY(status);
    *product = QDOT_NIL;
    qdot_field_begin(&f, pool, 1, &prepared, WORK);
    if (qdot_field_goes(&f)) {
        qdot_expr result = QDOT_ONE;
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, prepared);
        if (fmpz_mpoly_is_zero(r.n, f.ctx)) {
            result = QDOT_ZERO;
        } else if (qdot_field_goes(&f)) {
            status = collect(&f, r.n, 1, &result, list, n, &capacity);
            if (status == QDOT_OK)
                status = collect(&f, r.d, -1, &result, NULL, NULL, NULL);
        }
        if (status == QDOT_OK && qdot_field_goes(&f))
            *product = result;
        qdot_ratio_clear(&f, &r);
    }
    if (status == QDOT_OK && f.state == QDOT_FIELD_FAILED)
        status = f.status;
    qdot_field_end(&f);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    return status;
}

/* --- guarded ----------------------------------------------------------------------------- */

struct factoring {
    qdot_pool *pool;
    qdot_expr e, result;
};

static void
list_factors(void *user)
{
    struct factoring *x = user;
    qdot_expr product = QDOT_NIL, *list = NULL;
    size_t n = 0;
    qdot_status status = factors_of(x->pool, x->e, &product, &list, &n);

    if (status != QDOT_OK)
        x->result = qdot_pool_fail(x->pool);
    else if (product == QDOT_NIL || product == QDOT_ZERO)
        x->result = qdot_list(x->pool, 1, product == QDOT_NIL ? &x->e : &product);
    else
        x->result = qdot_list(x->pool, (uint32_t)n, list);
    qdot_free(list);
}

qdot_expr
qdot_solve_factors(qdot_pool *pool, qdot_expr e)
{
    struct factoring x = {pool, e, QDOT_NIL};
    qdot_status status = qdot_flint_run(pool, list_factors, &x);

    if (status == QDOT_ELIMIT)
        return qdot_list(pool, 1, &e);
    return status == QDOT_OK ? x.result : qdot_pool_fail(pool);
}

/* --- functions as they stand ----------------------------------------------------------------- */

enum { MOST_FUNCTIONS = 32 };

/* Functions and the symbols in their places. */
struct unrelated {
    uint32_t n;
    qdot_expr of[MOST_FUNCTIONS], as[MOST_FUNCTIONS];
};

static qdot_expr
as_symbol(qdot_pool *pool, qdot_expr node, void *user)
{
    struct unrelated *u = user;
    char name[32];

    if (qdot_expr_kind(pool, node) != QDOT_FUN)
        return QDOT_NIL;
    for (uint32_t i = 0; i < u->n; i++)
        if (u->of[i] == node)
            return u->as[i];
    if (u->n == MOST_FUNCTIONS)
        return node;
    snprintf(name, sizeof name, "(function %u)", u->n);
    u->of[u->n] = node;
    return u->as[u->n++] = qdot_symbol_get(pool, QDOT_FORMAL, name);
}

/* How many factors stand above, each as often as its power says; 0: one of them can be said
 * shorter, as sin(x)^2 + cos(x)^2 can. */
static long
count_factors(qdot_pool *pool, qdot_expr e)
{
    bool product = qdot_expr_kind(pool, e) == QDOT_PROD;
    uint32_t n = product ? qdot_expr_count(pool, e) : 2;
    long count = 0, power;

    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr base = product ? qdot_expr_arg(pool, e, i) : e,
                  shorter = qdot_simplify(pool, base, NULL);

        if (shorter == QDOT_NIL ||
            qdot_expr_size(pool, shorter) < qdot_expr_size(pool, base))
            return 0;
        if (!product || !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &power))
            power = 1;
        count += power > 0 ? power : 0;
    }
    return count;
}

/* The product by all that relates functions to each other, or the one in which they stand for
 * themselves, sin(y)^2 for (1 - cos(y)) (1 + cos(y)): more factors, then fewer operations. */
static qdot_expr
product_of(qdot_pool *pool, qdot_expr e, void *user)
{
    struct unrelated u = {0};
    qdot_expr related = QDOT_NIL, apart = QDOT_NIL, bare;
    long more;

    (void)user;
    if (factors_of(pool, e, &related, NULL, NULL) != QDOT_OK)
        return qdot_pool_fail(pool);
    related = related == QDOT_NIL ? e : related;
    bare = qdot_walk_map(pool, e, as_symbol, &u);
    if (bare == QDOT_NIL || u.n == 0)
        return bare == QDOT_NIL ? QDOT_NIL : related;
    if (factors_of(pool, bare, &apart, NULL, NULL) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (apart == QDOT_NIL || related == QDOT_ZERO)
        return related;
    apart = qdot_subs(pool, apart, u.n, u.as, u.of);
    if (apart == QDOT_NIL)
        return QDOT_NIL;
    more = count_factors(pool, apart);
    more = more == 0 ? -1 : more - count_factors(pool, related);
    return more > 0 || (more == 0 &&
                        qdot_expr_size(pool, apart) < qdot_expr_size(pool, related))
               ? apart
               : related;
}

static void
make_product(void *user)
{
    struct factoring *x = user;

    x->result = qdot_value_map(x->pool, x->e, product_of, NULL);
}

qdot_expr
qdot_solve_product(qdot_pool *pool, qdot_expr e)
{
    struct factoring x = {pool, e, e};
    qdot_status status = e == QDOT_NIL ? QDOT_OK : qdot_flint_run(pool, make_product, &x);

    if (status == QDOT_ELIMIT)
        return e;
    return status == QDOT_OK ? x.result : qdot_pool_fail(pool);
}
