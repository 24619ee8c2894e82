/* solve-factors.c -- an expression as a product. */
#include "base/memory.h"
#include "expr/tensor.h"
#include "normal/factor.h"
#include "normal/flint.h"
#include "normal/prepare.h"
#include "normal/simplify.h"
#include "normal/solve.h"

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

        qdot_ratio_init(&f, &r);
        qdot_ratio_set(&f, &r, qdot_field_value(&f, prepared));
        qdot_ratio_cancel(&f, &r);
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

static qdot_expr
product_of(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr product = QDOT_NIL;

    (void)user;
    if (factors_of(pool, e, &product, NULL, NULL) != QDOT_OK)
        return qdot_pool_fail(pool);
    return product == QDOT_NIL ? e : product;
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
