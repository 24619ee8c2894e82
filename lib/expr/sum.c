/* sum.c -- sums: maps term -> rational coefficient. */
#include "expr/pool.h"

#include <stdlib.h>

struct term {
    qdot_expr term;
    fmpq c;
};

struct sum {
    qdot_pool *pool;
    fmpq constant;
    struct term few[16], *at;
    size_t n, capacity;
    bool failed;
};

static void
begin(struct sum *s, qdot_pool *pool)
{
    s->pool = pool;
    fmpq_init(&s->constant);
    s->at = s->few;
    s->n = 0;
    s->capacity = sizeof s->few / sizeof *s->few;
    s->failed = false;
}

static void
end(struct sum *s)
{
    for (size_t i = 0; i < s->n; i++)
        fmpq_clear(&s->at[i].c);
    fmpq_clear(&s->constant);
    if (s->at != s->few)
        qdot_free(s->at);
}

/* Append c1 * c2 * term, term without a coefficient of its own. */
static void
push(struct sum *s, qdot_expr term, const fmpq *c1, const fmpq *c2)
{
    if (s->n == s->capacity) {
        struct term *old = s->at, *bigger = NULL;
        size_t capacity = s->at == s->few ? 0 : s->capacity;

        if (s->at != s->few)
            bigger = s->at;
        if (qdot_grow(&bigger, &capacity, s->n * 2, sizeof *bigger) != QDOT_OK) {
            qdot_pool_fail(s->pool);
            s->failed = true;
            return;
        }
        if (old == s->few)
            for (size_t i = 0; i < s->n; i++)
                bigger[i] = old[i];
        s->at = bigger;
        s->capacity = capacity;
    }
    s->at[s->n].term = term;
    fmpq_init(&s->at[s->n].c);
    if (c2 == NULL)
        fmpq_set(&s->at[s->n].c, c1);
    else
        fmpq_mul(&s->at[s->n].c, c1, c2);
    s->n++;
}

static void
add(struct sum *s, qdot_expr e, const fmpq *c)
{
    qdot_pool *pool = s->pool;
    fmpq_t own, product;

    switch (NODE(pool, e)->kind) {
    case QDOT_NUM:
        fmpq_init(product);
        fmpq_mul(product, RATIONAL(pool, e), c);
        fmpq_add(&s->constant, &s->constant, product);
        fmpq_clear(product);
        return;
    case QDOT_SUM:
        fmpq_init(product);
        fmpq_mul(product, RATIONAL(pool, ARGS(pool, e)[0]), c);
        fmpq_add(&s->constant, &s->constant, product);
        fmpq_clear(product);
        for (uint32_t i = 1; i < NODE(pool, e)->n && !s->failed; i += 2)
            push(s, ARGS(pool, e)[i], RATIONAL(pool, ARGS(pool, e)[i + 1]), c);
        return;
    case QDOT_PROD:
        fmpq_init(own);
        e = qdot_expr_unscale(pool, e, own);
        fmpq_mul(own, own, c);
        if (e != QDOT_NIL && NODE(pool, e)->kind == QDOT_SUM)
            add(s, e, own); /* one level: a coefficient times a bare sum */
        else if (e != QDOT_NIL)
            push(s, e, own, NULL);
        fmpq_clear(own);
        return;
    default:
        push(s, e, c, NULL);
    }
}

static int
by_id(const void *a, const void *b)
{
    const struct term *x = a, *y = b;

    return x->term < y->term ? -1 : x->term > y->term;
}

static int
by_order(const void *a, const void *b, void *pool)
{
    const struct term *x = a, *y = b;

    return qdot_expr_compare_terms(pool, x->term, y->term);
}

/* Like terms together, zeros out. */
static void
merge(struct sum *s)
{
    size_t kept = 0;

    qsort(s->at, s->n, sizeof *s->at, by_id);
    for (size_t i = 0; i < s->n; i++) {
        if (kept > 0 && s->at[kept - 1].term == s->at[i].term) {
            fmpq_add(&s->at[kept - 1].c, &s->at[kept - 1].c, &s->at[i].c);
            fmpq_clear(&s->at[i].c);
            if (fmpq_is_zero(&s->at[kept - 1].c))
                fmpq_clear(&s->at[--kept].c);
        } else {
            s->at[kept++] = s->at[i];
        }
    }
    s->n = kept;
}

static qdot_expr
finish(struct sum *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr few[33], *args = few, e = QDOT_NIL;

    if (s->failed || qdot_pool_failed(pool))
        return QDOT_NIL;
    merge(s);
    if (s->n == 0)
        return qdot_expr_fmpq(pool, &s->constant);
    if (s->n == 1 && fmpq_is_zero(&s->constant))
        return qdot_expr_scale(pool, &s->at[0].c, s->at[0].term);
    qsort_r(s->at, s->n, sizeof *s->at, by_order, pool);
    if (s->n > 16 && (args = qdot_malloc((2 * s->n + 1) * sizeof *args)) == NULL)
        return qdot_pool_fail(pool);
    args[0] = qdot_expr_fmpq(pool, &s->constant);
    for (size_t i = 0; i < s->n; i++) {
        args[1 + 2 * i] = s->at[i].term;
        args[2 + 2 * i] = qdot_expr_fmpq(pool, &s->at[i].c);
    }
    if (!qdot_pool_failed(pool)) {
        uint32_t n = (uint32_t)(2 * s->n + 1);

        e = qdot_pool_intern(pool, QDOT_SUM, 0, n, args, qdot_sign_of_sum(pool, n, args));
    }
    if (args != few)
        qdot_free(args);
    return e;
}

/* Whether every e is a number; else the pool keeps why not. */
static bool
scalars(qdot_pool *pool, size_t n, const qdot_expr *e)
{
    for (size_t i = 0; i < n; i++) {
        if (e[i] == QDOT_NIL)
            return false;
        if (!qdot_expr_is_scalar(pool, e[i])) {
            qdot_pool_refuse(pool, QDOT_ETYPE, "a number is needed here");
            return false;
        }
    }
    return !qdot_pool_failed(pool);
}

qdot_expr
qdot_sum(qdot_pool *pool, size_t n, const qdot_expr *terms)
{
    struct sum s;
    qdot_expr e = QDOT_NIL;
    fmpq one;

    if (!scalars(pool, n, terms))
        return QDOT_NIL;
    if (n == 1)
        return terms[0];
    begin(&s, pool);
    fmpq_init(&one);
    fmpq_one(&one);
    for (size_t i = 0; i < n && !s.failed; i++)
        add(&s, terms[i], &one);
    e = finish(&s);
    fmpq_clear(&one);
    end(&s);
    return e;
}

qdot_expr
qdot_add(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (a == QDOT_ZERO && b != QDOT_NIL && qdot_expr_is_scalar(pool, b))
        return b;
    if (b == QDOT_ZERO && a != QDOT_NIL && qdot_expr_is_scalar(pool, a))
        return a;
    return qdot_sum(pool, 2, (qdot_expr[]){a, b});
}

qdot_expr
qdot_sub(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_add(pool, a, qdot_neg(pool, b));
}

qdot_expr
qdot_neg(qdot_pool *pool, qdot_expr a)
{
    return qdot_mul(pool, QDOT_MINUS_ONE, a);
}
