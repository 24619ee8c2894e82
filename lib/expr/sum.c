/* sum.c -- makes sums of expressions; a sum is stored as terms with rational coefficients. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

#include <stdlib.h>
#include <string.h>

/* A term with its coefficient: a NUM of the pool (id) if it exists, otherwise the rational c. */
struct term {
    qdot_expr term, id;
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
begin_sum(struct sum *s, qdot_pool *pool)
{
    s->pool = pool;
    fmpq_init(&s->constant);
    s->at = s->few;
    s->n = 0;
    s->capacity = sizeof s->few / sizeof *s->few;
    s->failed = false;
}

static void
free_term(struct term *t)
{
    if (t->id == QDOT_NIL)
        fmpq_clear(&t->c);
}

static void
free_sum(struct sum *s)
{
    for (size_t i = 0; i < s->n; i++)
        free_term(&s->at[i]);
    fmpq_clear(&s->constant);
    if (s->at != s->few)
        qdot_free(s->at);
}

static void
sum_fail(struct sum *s)
{
    qdot_pool_fail(s->pool);
    s->failed = true;
}

static const fmpq *
coefficient_of_term(const struct sum *s, const struct term *t)
{
    return t->id != QDOT_NIL ? RATIONAL(s->pool, t->id) : &t->c;
}

/* Append a * b * term; a and b are numbers, and the term has no coefficient. */
static void
push_term(struct sum *s, qdot_expr term, qdot_expr a, qdot_expr b)
{
    struct term *t;

    if (s->n == s->capacity) {
        struct term *bigger = s->at == s->few ? NULL : s->at;
        size_t capacity = s->at == s->few ? 0 : s->capacity;

        if (qdot_grow(&bigger, &capacity, s->n * 2, sizeof *bigger) != QDOT_OK) {
            sum_fail(s);
            return;
        }
        if (s->at == s->few)
            memcpy(bigger, s->few, sizeof s->few);
        s->at = bigger;
        s->capacity = capacity;
    }
    t = &s->at[s->n++];
    t->term = term;
    if (a == QDOT_ONE || b == QDOT_ONE) {
        t->id = a == QDOT_ONE ? b : a;
    } else if (a == QDOT_MINUS_ONE && b == QDOT_MINUS_ONE) {
        t->id = QDOT_ONE;
    } else {
        t->id = QDOT_NIL;
        fmpq_init(&t->c);
        qdot_rational_mul(&t->c, RATIONAL(s->pool, a), RATIONAL(s->pool, b));
    }
}

static void
add_number_to_sum(struct sum *s, qdot_expr a, qdot_expr b)
{
    if (a != QDOT_ZERO && b != QDOT_ZERO)
        qdot_rational_addmul(&s->constant, RATIONAL(s->pool, a), RATIONAL(s->pool, b));
}

/* Add c times e to the sum, where c is a number. */
static void
add_multiple_to_sum(struct sum *s, qdot_expr e, qdot_expr c)
{
    qdot_pool *pool = s->pool;
    qdot_expr own, rest;

    switch (NODE(pool, e)->kind) {
    case QDOT_NUM: add_number_to_sum(s, e, c); return;
    case QDOT_PROD:
        own = ARGS(pool, e)[0];
        if (own == QDOT_ONE) {
            push_term(s, e, c, QDOT_ONE);
            return;
        }
        rest = qdot_expr_strip(pool, e);
        if (rest == QDOT_NIL)
            sum_fail(s);
        else if (NODE(pool, rest)->kind != QDOT_SUM)
            push_term(s, rest, own, c);
        else if ((c = qdot_mul(pool, own, c)) == QDOT_NIL)
            sum_fail(s);
        else
            add_multiple_to_sum(s, rest, c); /* one level of recursion only, since `rest` has no coefficient */
        return;
    case QDOT_SUM:
        add_number_to_sum(s, ARGS(pool, e)[0], c);
        for (uint32_t i = 1; i < NODE(pool, e)->n && !s->failed; i += 2)
            push_term(s, ARGS(pool, e)[i], ARGS(pool, e)[i + 1], c);
        return;
    default: push_term(s, e, c, QDOT_ONE);
    }
}

/* --- sorting and merging terms ------------------------------------------------------------ */

static int
compare_term_ids(const void *a, const void *b)
{
    const struct term *x = a, *y = b;

    return x->term < y->term ? -1 : x->term > y->term;
}

static bool
terms_are_ordered(const struct sum *s, const struct term *a, const struct term *b)
{
    return a->term == b->term || qdot_expr_compare_terms(s->pool, a->term, b->term) < 0;
}

/* Combine equal neighbouring terms, and drop zeros. */
static void
merge_equal_terms(struct sum *s)
{
    size_t kept = 0;

    for (size_t i = 0; i < s->n; i++) {
        struct term *last, *t = &s->at[i];
        fmpq_t c;

        if (kept == 0 || s->at[kept - 1].term != t->term) {
            s->at[kept++] = *t;
            continue;
        }
        last = &s->at[kept - 1];
        fmpq_init(c);
        qdot_rational_add(c, coefficient_of_term(s, last), coefficient_of_term(s, t));
        free_term(last);
        free_term(t);
        last->id = QDOT_NIL;
        last->c = *c;
        if (fmpq_is_zero(c)) {
            fmpq_clear(c);
            kept--;
        }
    }
    s->n = kept;
}

/* Merge the sorted runs a ... b and b ... c of `from` into `to`. */
static void
merge_runs(const struct sum *s, const struct term *from, size_t a, size_t b, size_t c,
           struct term *to)
{
    size_t i = a, k = b;

    for (size_t n = a; n < c; n++)
        to[n] =
            k == c || (i < b && terms_are_ordered(s, &from[i], &from[k])) ? from[i++] : from[k++];
}

/* Sort the terms by merging existing runs, as the terms of sums are already sorted. */
static void
merge_sorted_runs(struct sum *s, uint32_t *start, size_t runs)
{
    struct term *other = qdot_malloc(s->n * sizeof *other), *from = s->at, *to = other;

    if (other == NULL) {
        sum_fail(s);
        return;
    }
    while (runs > 1) {
        size_t kept = 0;
        struct term *swap;

        for (size_t r = 0; r < runs; r += 2) {
            size_t b = r + 1 < runs ? start[r + 1] : s->n,
                   c = r + 2 < runs ? start[r + 2] : s->n;

            merge_runs(s, from, start[r], b, c, to);
            start[kept++] = start[r];
        }
        runs = kept;
        swap = from;
        from = to;
        to = swap;
    }
    if (from != s->at)
        memcpy(s->at, from, s->n * sizeof *from);
    qdot_free(other);
}

static void
sort_few_terms(struct sum *s)
{
    for (size_t i = 1; i < s->n; i++) {
        struct term t = s->at[i];
        size_t k = i;

        for (; k > 0 && !terms_are_ordered(s, &s->at[k - 1], &t); k--)
            s->at[k] = s->at[k - 1];
        s->at[k] = t;
    }
}

static void
sort_terms(struct sum *s)
{
    uint32_t *start;
    size_t runs;

    if (s->n <= 8) {
        sort_few_terms(s);
        merge_equal_terms(s);
        return;
    }
    start = qdot_malloc(s->n * sizeof *start);
    if (start == NULL) {
        sum_fail(s);
        return;
    }
    for (int pass = 0; pass < 2; pass++) {
        runs = 0;
        for (size_t i = 0; i < s->n; i++)
            if (i == 0 || !terms_are_ordered(s, &s->at[i - 1], &s->at[i]))
                start[runs++] = (uint32_t)i;
        if (pass == 1 || runs < s->n / 4 || s->n < 64)
            break;
        /* the items have no order, as after multiplying out: put like terms together, by their ids */
        qsort(s->at, s->n, sizeof *s->at, compare_term_ids);
        merge_equal_terms(s);
    }
    if (runs > 1)
        merge_sorted_runs(s, start, runs);
    qdot_free(start);
    merge_equal_terms(s);
}

static qdot_expr
make_sum_node(struct sum *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr few[33], *args = few, e = QDOT_NIL;

    if (s->failed || FAILED(pool))
        return QDOT_NIL;
    sort_terms(s);
    if (s->failed)
        return QDOT_NIL;
    if (s->n == 0)
        return qdot_expr_fmpq(pool, &s->constant);
    if (s->n == 1 && fmpq_is_zero(&s->constant)) {
        qdot_expr c = s->at[0].id;

        if (c == QDOT_NIL)
            c = qdot_expr_fmpq(pool, &s->at[0].c);
        return qdot_mul(pool, c, s->at[0].term);
    }
    if (s->n > 16 && (args = qdot_malloc((2 * s->n + 1) * sizeof *args)) == NULL)
        return qdot_pool_fail(pool);
    args[0] = fmpq_is_zero(&s->constant) ? QDOT_ZERO : qdot_expr_fmpq(pool, &s->constant);
    for (size_t i = 0; i < s->n; i++) {
        args[1 + 2 * i] = s->at[i].term;
        args[2 + 2 * i] =
            s->at[i].id != QDOT_NIL ? s->at[i].id : qdot_expr_fmpq(pool, &s->at[i].c);
    }
    if (!FAILED(pool)) {
        uint32_t n = (uint32_t)(2 * s->n + 1);

        e = qdot_pool_intern(pool, QDOT_SUM, 0, n, args, qdot_sign_of_sum(pool, n, args));
    }
    if (args != few)
        qdot_free(args);
    return e;
}

/* --- making sums ---------------------------------------------------------------------------- */

/* Whether every e is scalar; if not the pool keeps the failure. */
static bool
check_all_scalar(qdot_pool *pool, size_t n, const qdot_expr *e)
{
    if (FAILED(pool))
        return false;
    for (size_t i = 0; i < n; i++) {
        if (e[i] == QDOT_NIL)
            return false;
        if (!qdot_pool_is_scalar(pool, e[i])) {
            qdot_pool_refuse(pool, QDOT_ETYPE, "a number is needed here");
            return false;
        }
    }
    return true;
}

/* The sum of c[i] times terms[i]; c NULL: all coefficients are 1. */
static qdot_expr
make_linear_combination(qdot_pool *pool, size_t n, const qdot_expr *c, const qdot_expr *terms)
{
    struct sum s;
    qdot_expr e;
    size_t only = 0, count = 0;

    if (!check_all_scalar(pool, n, terms))
        return QDOT_NIL;
    for (size_t i = 0; i < n && count < 2; i++)
        if (terms[i] != QDOT_ZERO) {
            only = i;
            count++;
        }
    if (count < 2)
        return count == 0  ? QDOT_ZERO
               : c == NULL ? terms[only]
                           : qdot_mul(pool, c[only], terms[only]);
    begin_sum(&s, pool);
    /* sums of numbers make no nodes, so Ctrl-C is tested here */
    for (size_t i = 0; i < n && !s.failed && !qdot_pool_interrupted(pool); i++)
        add_multiple_to_sum(&s, terms[i], c == NULL ? QDOT_ONE : c[i]);
    e = make_sum_node(&s);
    free_sum(&s);
    return e;
}

qdot_expr
qdot_sum(qdot_pool *pool, size_t n, const qdot_expr *terms)
{
    return make_linear_combination(pool, n, NULL, terms);
}

qdot_expr
qdot_sum_scaled(qdot_pool *pool, size_t n, const qdot_expr *c, const qdot_expr *terms)
{
    if (!check_all_scalar(pool, n, c))
        return QDOT_NIL;
    return make_linear_combination(pool, n, c, terms);
}

qdot_expr
qdot_add(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return make_linear_combination(pool, 2, NULL, (qdot_expr[]){a, b});
}

qdot_expr
qdot_sub(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return make_linear_combination(pool, 2, (qdot_expr[]){QDOT_ONE, QDOT_MINUS_ONE}, (qdot_expr[]){a, b});
}

qdot_expr
qdot_neg(qdot_pool *pool, qdot_expr a)
{
    return qdot_mul(pool, QDOT_MINUS_ONE, a);
}
