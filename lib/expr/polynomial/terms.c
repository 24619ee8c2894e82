/* terms.c -- finds the variables of expressions, and turns sums into polynomials and polynomials into sums. */
#include "expr/polynomial/terms.h"

#include <stdlib.h>

#include <flint/fmpq.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/pool.h"

/* --- the terms of an expression ----------------------------------------------------------- */

/* The number of terms of e, its constant first if it has one; an expression that is no sum is one term. */
static uint32_t
number_of_terms(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_SUM ? (NODE(pool, e)->n + 1) / 2 : 1;
}

/* Split term i into its number, which is returned, and the rest, which is nil for a constant. */
static const fmpq *
split_term(const qdot_pool *pool, qdot_expr e, uint32_t i, qdot_expr *rest)
{
    const qdot_expr *args = ARGS(pool, e);
    static const fmpq one = {1, 1};

    if (NODE(pool, e)->kind == QDOT_SUM) {
        *rest = i == 0 ? QDOT_NIL : args[2 * i - 1];
        return RATIONAL(pool, args[2 * i]);
    }
    *rest = NODE(pool, e)->kind == QDOT_NUM ? QDOT_NIL : e;
    return NODE(pool, e)->kind == QDOT_NUM    ? RATIONAL(pool, e)
           : NODE(pool, e)->kind == QDOT_PROD ? RATIONAL(pool, args[0])
                                              : &one;
}

/* Factor i of a term: base^unit to the power k >= 1. */
static qdot_variable_power
split_factor(qdot_pool *pool, qdot_expr term, uint32_t i, ulong *k)
{
    qdot_variable_power x = {term, QDOT_ONE};
    const fmpq *exponent;
    int64_t n;

    *k = 1;
    if (NODE(pool, term)->kind != QDOT_PROD)
        return x;
    x.base = ARGS(pool, term)[1 + 2 * i];
    x.unit = ARGS(pool, term)[2 + 2 * i];
    exponent = NUMBER(pool, x.unit);
    if (exponent == NULL || COEFF_IS_MPZ(exponent->num) || COEFF_IS_MPZ(exponent->den) || exponent->num == 0)
        return x;
    n = exponent->num < 0 ? -1 : 1;
    *k = (ulong)(n * exponent->num);
    x.unit = exponent->den != 1 ? qdot_expr_ratio(pool, n, exponent->den) : n > 0 ? QDOT_ONE : QDOT_MINUS_ONE;
    return x;
}

static uint32_t
number_of_factors(const qdot_pool *pool, qdot_expr term)
{
    return term == QDOT_NIL ? 0 : NODE(pool, term)->kind == QDOT_PROD ? (NODE(pool, term)->n - 1) / 2 : 1;
}

/* --- the variables ------------------------------------------------------------------------ */

static int
compare_ids(const void *a, const void *b)
{
    const qdot_variable_power *x = a, *y = b;

    return x->base != y->base ? (x->base < y->base ? -1 : 1) : x->unit < y->unit ? -1 : x->unit > y->unit;
}

static int
compare_powers(const void *a, const void *b, void *pool)
{
    const qdot_variable_power *x = a, *y = b;
    const int d = qdot_expr_compare(pool, y->base, x->base);

    return d != 0 ? d : qdot_expr_compare(pool, y->unit, x->unit);
}

/* Sort the powers that were found by ids, each once. */
static void
drop_equal_powers(qdot_variables *v)
{
    size_t kept = 0;

    if (v->at.n > 1)
        qsort(v->at.at, v->at.n, sizeof *v->at.at, compare_ids);
    for (size_t i = 0; i < v->at.n; i++)
        if (kept == 0 || compare_ids(&v->at.at[kept - 1], &v->at.at[i]) != 0)
            v->at.at[kept++] = v->at.at[i];
    v->at.n = kept;
}

void
qdot_variables_find(qdot_variables *v, qdot_expr e)
{
    size_t most = 64;

    for (uint32_t i = 0; e != QDOT_NIL && i < number_of_terms(v->pool, e) && !FAILED(v->pool); i++) {
        qdot_expr rest;

        (void)split_term(v->pool, e, i, &rest);
        for (uint32_t j = 0; j < number_of_factors(v->pool, rest); j++) {
            ulong k;

            if (qdot_vec_push(&v->at, split_factor(v->pool, rest, j, &k)) != QDOT_OK)
                qdot_pool_fail(v->pool);
        }
        if (v->at.n > most) {
            drop_equal_powers(v);
            most = 2 * v->at.n > 64 ? 2 * v->at.n : 64;
        }
    }
}

/* Whether products of powers of x and of others need only be sorted: no other factor can change x but its like. */
static bool
combines_with_equal_base(const qdot_pool *pool, const qdot_variable_power *x)
{
    const qdot_node *base = NODE(pool, x->base);

    if (x->unit != QDOT_ONE && x->unit != QDOT_MINUS_ONE)
        return false;
    return base->kind == QDOT_SYM || base->kind == QDOT_INTEGRAL || base->kind == QDOT_UFUN ||
           (base->kind == QDOT_FUN && base->op != QDOT_EXP && base->op != QDOT_ABS) ||
           (base->kind == QDOT_SUM && x->unit == QDOT_MINUS_ONE && !qdot_expr_is_negative(pool, x->base));
}

void
qdot_variables_settle(qdot_variables *v)
{
    drop_equal_powers(v);
    if (v->at.n > 1)
        qsort_r(v->at.at, v->at.n, sizeof *v->at.at, compare_powers, v->pool);
    v->n = (slong)v->at.n;
    v->apart = true;
    for (size_t i = 0; i < v->at.n; i++)
        v->apart &= combines_with_equal_base(v->pool, &v->at.at[i]) &&
                    (i == 0 || v->at.at[i].base != v->at.at[i - 1].base);
    fmpz_mpoly_ctx_init(v->ctx, v->n, ORD_LEX);
    v->exp = qdot_calloc(v->at.n + 1, sizeof *v->exp);
    if (v->exp == NULL)
        qdot_pool_fail(v->pool);
}

void
qdot_variables_end(qdot_variables *v)
{
    fmpz_mpoly_ctx_clear(v->ctx);
    qdot_free(v->exp);
    qdot_free(v->at.at);
}

/* The place of the variable for base^unit. */
static slong
place_of_power(const qdot_variables *v, const qdot_variable_power *x)
{
    slong low = 0, high = v->n - 1;

    while (low < high) {
        const slong middle = (low + high) / 2;

        if (compare_powers(&v->at.at[middle], x, v->pool) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* --- expression to polynomial ------------------------------------------------------------- */

void
qdot_terms_read(qdot_variables *v, fmpz_mpoly_t p, fmpq_t c, qdot_expr e)
{
    qdot_pool *pool = v->pool;
    fmpz_t integer;
    qdot_expr rest;

    fmpq_one(c);
    fmpz_mpoly_zero(p, v->ctx);
    for (uint32_t i = 0; i < number_of_terms(pool, e); i++)
        fmpz_lcm(fmpq_denref(c), fmpq_denref(c), fmpq_denref(split_term(pool, e, i, &rest)));
    fmpz_init(integer);
    for (uint32_t i = 0; i < number_of_terms(pool, e) && !FAILED(pool); i++) {
        const fmpq *coefficient = split_term(pool, e, i, &rest);

        if (fmpq_is_zero(coefficient))
            continue;
        for (uint32_t j = 0; j < number_of_factors(pool, rest); j++) {
            ulong k;
            qdot_variable_power x = split_factor(pool, rest, j, &k);

            v->exp[place_of_power(v, &x)] += k;
        }
        fmpz_divexact(integer, fmpq_denref(c), fmpq_denref(coefficient));
        fmpz_mul(integer, integer, fmpq_numref(coefficient));
        fmpz_mpoly_push_term_fmpz_ui(p, integer, v->exp, v->ctx);
        for (uint32_t j = 0; j < number_of_factors(pool, rest); j++) {
            ulong k;
            qdot_variable_power x = split_factor(pool, rest, j, &k);

            v->exp[place_of_power(v, &x)] = 0;
        }
    }
    fmpz_clear(integer);
    fmpz_mpoly_sort_terms(p, v->ctx);
    fmpz_mpoly_combine_like_terms(p, v->ctx);
}

/* --- polynomial to expression ------------------------------------------------------------- */

/* A term, and where it stands in the sum. */
typedef struct {
    uint64_t key[2];
    qdot_expr coefficient, rest;
} written_term;

typedef struct {
    qdot_variables *v;
    qdot_expr *args;            /* [2 n + 1] work space */
    slong *most;                /* [n] degrees */
    qdot_expr *number[2];       /* the exponents k and -k as expressions, nil: not needed yet */
    ulong numbers;              /* for k below this */
    unsigned bits;              /* of a key */
    qdot_vec(written_term) terms;
} writing;

/* Exponents are kept as expressions up to this one. */
#define MOST_NUMBERS 4096

static int
compare_keys(const void *a, const void *b)
{
    const written_term *x = a, *y = b;
    const int i = x->key[0] == y->key[0];

    return x->key[i] < y->key[i] ? -1 : x->key[i] > y->key[i];
}

/* The number of bits of x. */
static unsigned
count_bits(uint64_t x)
{
    unsigned bits = 0;

    for (; x > 0; x >>= 1)
        bits++;
    return bits;
}

/* Append digits of `bits` < 64 bits to the key of a term. */
static void
key_append(uint64_t *key, uint64_t digit, unsigned bits)
{
    if (bits == 0)
        return;
    key[0] = key[0] << bits | key[1] >> (64 - bits);
    key[1] = key[1] << bits | digit;
}

/* The place of a term among others (qdot_expr_compare_terms): factors are compared from the last one on; a term without a
 * factor stands before those with it, a higher power before a lower one. */
static void
key_make(const writing *w, uint64_t *key)
{
    const qdot_variables *v = w->v;

    for (slong k = 0; k < v->n; k++) {
        const ulong e = v->exp[k];
        const bool inverse = v->at.at[k].unit == QDOT_MINUS_ONE;

        key_append(key, e == 0 ? 0 : inverse ? e : (ulong)w->most[k] - e + 1, count_bits((uint64_t)w->most[k] + 1));
    }
}

static qdot_expr
write_exponent(writing *w, ulong e, bool inverse)
{
    qdot_expr *kept = e < w->numbers ? &w->number[inverse][e] : NULL, number;

    if (kept != NULL && *kept != QDOT_NIL)
        return *kept;
    number = qdot_expr_int(w->v->pool, inverse ? -(int64_t)e : (int64_t)e);
    if (kept != NULL)
        *kept = number;
    return number;
}

/* e u, multiplied out if u is a sum. */
static qdot_expr
write_multiple(writing *w, qdot_expr u, ulong e)
{
    return e == 1 ? u : qdot_sum_scaled(w->v->pool, 2, (qdot_expr[]){write_exponent(w, e - 1, false), QDOT_ONE}, (qdot_expr[]){u, u});
}

/* The power of a variable as the product of many: exp(u)^3 is exp(3 u), |u|^3 is u^2 |u|. */
static qdot_expr
terms_write_power(writing *w, const qdot_variable_power *x, ulong e)
{
    qdot_pool *pool = w->v->pool;
    const bool whole = x->unit == QDOT_ONE;
    const qdot_expr u = NODE(pool, x->base)->kind == QDOT_FUN ? ARGS(pool, x->base)[0] : QDOT_NIL;

    if (whole && qdot_expr_is_function(pool, x->base, QDOT_EXP))
        return qdot_fun1(pool, QDOT_EXP, write_multiple(w, u, e));
    if (whole && qdot_expr_is_function(pool, x->base, QDOT_ABS))
        return qdot_mul(pool, qdot_pow(pool, u, write_exponent(w, e - e % 2, false)), e % 2 != 0 ? x->base : QDOT_ONE);
    return qdot_pow(pool, x->base, write_multiple(w, x->unit, e));
}

/* The product of the variables to the exponents v->exp. */
static qdot_expr
terms_write_product(writing *w)
{
    const qdot_variables *v = w->v;
    qdot_pool *pool = v->pool;
    qdot_expr *args = w->args;
    uint32_t n = 0;

    if (!v->apart) {
        for (slong k = v->n; k-- > 0;)
            if (v->exp[k] > 0)
                args[n++] = terms_write_power(w, &v->at.at[k], v->exp[k]);
        return qdot_product(pool, n, args);
    }
    args[n++] = QDOT_ONE;
    for (slong k = v->n; k-- > 0;)
        if (v->exp[k] > 0) {
            args[n++] = v->at.at[k].base;
            args[n++] = write_exponent(w, v->exp[k], v->at.at[k].unit == QDOT_MINUS_ONE);
        }
    if (n == 1)
        return QDOT_ONE;
    if (n == 3 && args[2] == QDOT_ONE)
        return args[1];
    return qdot_pool_intern(pool, QDOT_PROD, 0, n, args, qdot_sign_of_product(pool, n, args));
}

static bool
writing_begin(writing *w, qdot_variables *v, const fmpz_mpoly_t p)
{
    ulong most = 0;

    w->v = v;
    w->args = qdot_malloc((2 * (size_t)v->n + 1) * sizeof *w->args);
    w->most = qdot_calloc((size_t)v->n + 1, sizeof *w->most);
    if (w->args == NULL || w->most == NULL)
        return false;
    fmpz_mpoly_degrees_si(w->most, p, v->ctx);
    for (slong k = 0; k < v->n; k++) {
        w->most[k] = w->most[k] < 0 ? 0 : w->most[k];
        w->bits += count_bits((uint64_t)w->most[k] + 1);
        most = (ulong)w->most[k] > most ? (ulong)w->most[k] : most;
    }
    w->numbers = most < MOST_NUMBERS ? most + 1 : MOST_NUMBERS;
    for (int i = 0; i < 2; i++)
        if ((w->number[i] = qdot_calloc(w->numbers, sizeof *w->number[i])) == NULL)
            return false;
    return qdot_grow(&w->terms.at, &w->terms.capacity, (size_t)fmpz_mpoly_length(p, v->ctx) + 1,
                     sizeof *w->terms.at) == QDOT_OK;
}

static void
writing_end(writing *w)
{
    qdot_free(w->args);
    qdot_free(w->most);
    qdot_free(w->number[0]);
    qdot_free(w->number[1]);
    qdot_free(w->terms.at);
}

/* The sum of the terms written. */
static qdot_expr
terms_write_sum(writing *w)
{
    const size_t n = w->terms.n;
    qdot_expr *c = qdot_malloc((2 * n + 1) * sizeof *c), *rest = c + n, e;

    if (c == NULL)
        return qdot_pool_fail(w->v->pool);
    if (w->v->apart && w->bits <= 128 && n > 1)
        qsort(w->terms.at, n, sizeof *w->terms.at, compare_keys);
    for (size_t i = 0; i < n; i++) {
        c[i] = w->terms.at[i].coefficient;
        rest[i] = w->terms.at[i].rest;
    }
    e = qdot_sum_scaled(w->v->pool, n, c, rest);
    qdot_free(c);
    return e;
}

qdot_expr
qdot_terms_write(qdot_variables *v, const fmpz_mpoly_t p, const fmpq_t c)
{
    qdot_pool *pool = v->pool;
    writing w = {.bits = 0};
    qdot_expr e = QDOT_NIL;
    fmpq_t coefficient;

    fmpq_init(coefficient);
    if (!writing_begin(&w, v, p))
        qdot_pool_fail(pool);
    for (slong i = 0; !FAILED(pool) && i < fmpz_mpoly_length(p, v->ctx); i++) {
        written_term *t = &w.terms.at[w.terms.n++];

        *t = (written_term){{0, 0}, QDOT_NIL, QDOT_NIL};
        fmpz_mpoly_get_term_exp_ui(v->exp, p, i, v->ctx);
        fmpq_mul_fmpz(coefficient, c, p->coeffs + i);
        t->coefficient = qdot_expr_fmpq(pool, coefficient);
        t->rest = terms_write_product(&w);
        if (w.bits <= 128)
            key_make(&w, t->key);
    }
    if (!FAILED(pool))
        e = terms_write_sum(&w);
    writing_end(&w);
    fmpq_clear(coefficient);
    return e;
}
