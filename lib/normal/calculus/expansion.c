/* expansion.c -- expands expressions in rational powers of a small symbol. */
#include "normal/calculus/expansion.h"

#include <stdlib.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/inequality/sign.h"
#include "normal/prove/decide.h"
#include "normal/refute/constant.h"
#include "normal/simplify/simplify.h"

enum { MOST_TERMS = 60, MOST_SPAN = 12, MOST_DEPTH = 60, LARGE = 1000000 };

typedef struct {
    int64_t n, d; /* n/d, d > 0 */
} ratio;

typedef struct {
    ratio q;
    qdot_expr c;
} term;

/* The terms of exponents below `end`; `exact`: there are no others. */
typedef struct {
    qdot_vec(term) terms;
    ratio end;
    bool exact;
} powers;

typedef struct {
    qdot_expansion *x;
    ratio span; /* how far beyond its first term a series is expanded */
    int depth;
} work;

static qdot_status expand(work *k, qdot_expr e, powers *s);

/* --- rational exponents ---------------------------------------------------------------------------- */

static int64_t
gcd(int64_t a, int64_t b)
{
    while (b != 0) {
        const int64_t r = a % b;

        a = b;
        b = r;
    }
    return a < 0 ? -a : a;
}

static ratio
ratio_of(int64_t n, int64_t d)
{
    const int64_t g = gcd(n, d);

    return (ratio){n / (g ? g : 1), d / (g ? g : 1)};
}

static ratio
plus(ratio a, ratio b)
{
    return ratio_of(a.n * b.d + b.n * a.d, a.d * b.d);
}

static int
compare(ratio a, ratio b)
{
    const int64_t l = a.n * b.d, r = b.n * a.d;

    return l < r ? -1 : l > r;
}

static bool
is_too_large(ratio a)
{
    return llabs(a.n) > LARGE || a.d > 1000;
}

static ratio
least(ratio a, ratio b)
{
    return compare(a, b) < 0 ? a : b;
}

/* --- signs ------------------------------------------------------------------------------------------ */

int
qdot_proved_sign(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    const uint8_t known = qdot_expr_sign(pool, e);
    int sign;

    if (e == QDOT_ZERO)
        return 0;
    if ((known & QDOT_POS) == QDOT_POS || (known & QDOT_NEG) == QDOT_NEG)
        return known & QDOT_GE0 ? 1 : -1;
    if (qdot_expr_is_constant(pool, e)) {
        qdot_constant_sign of;

        if (qdot_constant_decide(pool, e, &of) == QDOT_OK && of != QDOT_CONSTANT_UNKNOWN)
            return of == QDOT_CONSTANT_ZERO ? 0 : of == QDOT_CONSTANT_POSITIVE ? 1 : -1;
        return 2;
    }
    return qdot_sign(pool, e, facts, &sign) == QDOT_OK && sign != 0 ? sign : 2;
}

/* --- arithmetic of series ----------------------------------------------------------------------------- */

static void
powers_clear(powers *s)
{
    qdot_free(s->terms.at);
    *s = (powers){0};
}

static ratio
leading(const powers *s)
{
    return s->terms.n > 0 ? s->terms.at[0].q : s->end;
}

/* Add c w^q to the terms, which stay in ascending order. */
static qdot_status
put_term(qdot_pool *pool, powers *s, ratio q, qdot_expr c)
{
    size_t at = s->terms.n;

    if (c == QDOT_ZERO || (!s->exact && compare(q, s->end) >= 0))
        return QDOT_OK;
    if (is_too_large(q) || s->terms.n > MOST_TERMS)
        return QDOT_EFAILED;
    while (at > 0 && compare(s->terms.at[at - 1].q, q) > 0)
        at--;
    if (at > 0 && compare(s->terms.at[at - 1].q, q) == 0) {
        s->terms.at[at - 1].c = qdot_add(pool, s->terms.at[at - 1].c, c);
        return QDOT_OK;
    }
    QDOT_TRY(qdot_vec_push(&s->terms, ((term){q, c})));
    for (size_t i = s->terms.n - 1; i > at; i--)
        s->terms.at[i] = s->terms.at[i - 1];
    s->terms.at[at] = (term){q, c};
    return QDOT_OK;
}

/* From `end` on nothing is known of s. */
static void
forget_from(powers *s, ratio end)
{
    s->end = s->exact ? end : least(s->end, end);
    s->exact = false;
    while (s->terms.n > 0 && compare(s->terms.at[s->terms.n - 1].q, s->end) >= 0)
        s->terms.n--;
}

static qdot_status
add_powers(qdot_pool *pool, powers *s, const powers *b, qdot_expr factor)
{
    if (!b->exact)
        forget_from(s, b->end);
    for (size_t i = 0; i < b->terms.n; i++)
        QDOT_TRY(put_term(pool, s, b->terms.at[i].q, qdot_mul(pool, factor, b->terms.at[i].c)));
    return QDOT_OK;
}

static qdot_status
multiply_powers(work *k, powers *s, const powers *b)
{
    qdot_pool *pool = k->x->pool;
    powers made = {.exact = s->exact && b->exact};
    const ratio first = plus(leading(s), leading(b));
    qdot_status status = QDOT_OK;

    if ((s->exact && s->terms.n == 0) || (b->exact && b->terms.n == 0)) {
        powers_clear(s);
        s->exact = true;
        return QDOT_OK;
    }
    if (!made.exact) {
        made.end = plus(first, k->span);
        if (!s->exact)
            made.end = least(made.end, plus(s->end, leading(b)));
        if (!b->exact)
            made.end = least(made.end, plus(b->end, leading(s)));
    }
    for (size_t i = 0; i < s->terms.n && status == QDOT_OK; i++)
        for (size_t j = 0; j < b->terms.n && status == QDOT_OK; j++)
            status = put_term(pool, &made, plus(s->terms.at[i].q, b->terms.at[j].q),
                              qdot_mul(pool, s->terms.at[i].c, b->terms.at[j].c));
    if (status == QDOT_OK && made.terms.n > 0 &&
        compare(made.terms.at[made.terms.n - 1].q, plus(first, k->span)) >= 0)
        forget_from(&made, plus(first, k->span));
    powers_clear(s);
    *s = made;
    return status;
}

/* Drop leading coefficients that are 0. QDOT_EFAILED where one is not proved to be 0 or not. */
static qdot_status
drop_zeros(work *k, powers *s)
{
    while (s->terms.n > 0) {
        qdot_decision decision = {.verdict = QDOT_UNDECIDED};
        const qdot_expr c = s->terms.at[0].c;

        QDOT_TRY(qdot_pool_check(k->x->pool));
        if ((qdot_expr_sign(k->x->pool, c) & QDOT_NE0) != 0)
            return QDOT_OK;
        QDOT_TRY(qdot_decide_equal(k->x->pool, c, QDOT_ZERO, k->x->facts, &decision));
        if (decision.verdict == QDOT_REFUTED)
            return QDOT_OK;
        if (decision.verdict == QDOT_UNDECIDED)
            return QDOT_EFAILED;
        for (size_t i = 1; i < s->terms.n; i++)
            s->terms.at[i - 1] = s->terms.at[i];
        s->terms.n--;
    }
    return QDOT_OK;
}

/* Split s into its first term and `rest`, s = first (1 + rest). QDOT_EFAILED: no term is known not to be 0. */
static qdot_status
split_first(work *k, powers *s, term *first, powers *rest)
{
    qdot_pool *pool = k->x->pool;

    QDOT_TRY(drop_zeros(k, s));
    if (s->terms.n == 0)
        return QDOT_EFAILED;
    *first = s->terms.at[0];
    *rest = (powers){.exact = s->exact, .end = plus(s->end, (ratio){-first->q.n, first->q.d})};
    for (size_t i = 1; i < s->terms.n; i++)
        QDOT_TRY(put_term(pool, rest, plus(s->terms.at[i].q, (ratio){-first->q.n, first->q.d}),
                          qdot_div(pool, s->terms.at[i].c, first->c)));
    return QDOT_OK;
}

/* s = sum c[i] d^i of a d that vanishes with w; next(i) gives c[i]. */
static qdot_status
compose(work *k, const powers *d, qdot_expr (*next)(void *user, int64_t i), void *user, powers *s)
{
    qdot_pool *pool = k->x->pool;
    powers power = {.exact = true};
    const ratio first = leading(d);
    qdot_status status = put_term(pool, &power, (ratio){0, 1}, QDOT_ONE);

    *s = (powers){.exact = true};
    for (int64_t i = 0; status == QDOT_OK; i++) {
        const qdot_expr c = next(user, i);

        status = c == QDOT_NIL ? QDOT_EFAILED : add_powers(pool, s, &power, c);
        if (status != QDOT_OK || (d->exact && d->terms.n == 0))
            break;
        if (compare((ratio){first.n * (i + 1), first.d}, k->span) >= 0) {
            forget_from(s, (ratio){first.n * (i + 1), first.d});
            break;
        }
        if (i >= MOST_TERMS)
            status = QDOT_EFAILED;
        else
            status = multiply_powers(k, &power, d);
    }
    powers_clear(&power);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* --- functions ------------------------------------------------------------------------------------------ */

/* The coefficients of (1 + d)^p, log(1 + d) and e^d, and of f(a + d). */
struct coefficients {
    qdot_pool *pool;
    qdot_expr p;       /* of the power */
    qdot_expr last;    /* the coefficient before */
    qdot_expr f, z, at; /* the i-th derivative as a function of z; the place */
};

static qdot_expr
binomial_coefficient(void *user, int64_t i)
{
    struct coefficients *c = user;

    if (i == 0)
        return c->last = QDOT_ONE;
    c->last = qdot_div(c->pool, qdot_mul(c->pool, c->last, qdot_sub(c->pool, c->p, qdot_expr_int(c->pool, i - 1))),
                       qdot_expr_int(c->pool, i));
    return c->last;
}

static qdot_expr
logarithm_coefficient(void *user, int64_t i)
{
    struct coefficients *c = user;

    return i == 0 ? QDOT_ZERO : qdot_expr_ratio(c->pool, i % 2 ? 1 : -1, (uint64_t)i);
}

static qdot_expr
taylor_coefficient(void *user, int64_t i)
{
    struct coefficients *c = user;
    qdot_expr value;

    if (i > 0)
        c->f = qdot_div(c->pool, qdot_diff(c->pool, c->f, c->z), qdot_expr_int(c->pool, i));
    value = qdot_subs(c->pool, c->f, 1, &c->z, &c->at);
    if (value == QDOT_NIL && qdot_grave(qdot_pool_check(c->pool)) != QDOT_OK)
        qdot_pool_fail(c->pool);
    return value;
}

/* s = s^p for a rational p. */
static qdot_status
raise_to(work *k, powers *s, const fmpq *p)
{
    qdot_pool *pool = k->x->pool;
    struct coefficients c = {.pool = pool, .p = qdot_expr_fmpq(pool, p)};
    term first;
    powers rest = {0}, made = {0};
    ratio q;
    qdot_expr front;
    qdot_status status = split_first(k, s, &first, &rest);

    if (status == QDOT_OK && !fmpz_is_one(fmpq_denref(p)) &&
        qdot_proved_sign(pool, first.c, k->x->facts) == -1 && fmpz_is_even(fmpq_denref(p))) {
        k->x->undefined = true;
        status = QDOT_EFAILED;
    }
    if (status == QDOT_OK && (!fmpz_fits_si(fmpq_numref(p)) || llabs(fmpz_get_si(fmpq_numref(p))) > 1000 ||
                              !fmpz_fits_si(fmpq_denref(p)) || fmpz_get_si(fmpq_denref(p)) > 1000))
        status = QDOT_EFAILED;
    if (status == QDOT_OK)
        status = compose(k, &rest, binomial_coefficient, &c, &made);
    if (status == QDOT_OK) {
        q = ratio_of(first.q.n * fmpz_get_si(fmpq_numref(p)), first.q.d * fmpz_get_si(fmpq_denref(p)));
        front = qdot_pow(pool, first.c, c.p);
        powers_clear(s);
        *s = (powers){.exact = made.exact, .end = plus(made.end, q)};
        for (size_t i = 0; i < made.terms.n && status == QDOT_OK; i++)
            status = put_term(pool, s, plus(made.terms.at[i].q, q), qdot_mul(pool, front, made.terms.at[i].c));
    }
    powers_clear(&rest);
    powers_clear(&made);
    return status;
}

/* s = log(s): log of the first coefficient, its exponent times log w, and a series. */
static qdot_status
take_logarithm(work *k, powers *s)
{
    qdot_pool *pool = k->x->pool;
    struct coefficients c = {.pool = pool};
    term first;
    powers rest = {0}, made = {0};
    qdot_status status = split_first(k, s, &first, &rest);

    if (status == QDOT_OK && qdot_proved_sign(pool, first.c, k->x->facts) == -1) {
        k->x->undefined = true;
        status = QDOT_EFAILED;
    }
    if (status == QDOT_OK)
        status = compose(k, &rest, logarithm_coefficient, &c, &made);
    if (status == QDOT_OK)
        status = put_term(pool, &made, (ratio){0, 1},
                          qdot_add(pool, qdot_fun1(pool, QDOT_LOG, first.c),
                                   qdot_mul(pool, qdot_expr_ratio(pool, first.q.n, (uint64_t)first.q.d),
                                            k->x->log_w)));
    powers_clear(&rest);
    powers_clear(s);
    *s = made;
    return status;
}

/* The term of order 0, taken out of s, of which nothing grows. QDOT_EFAILED: something does. */
static qdot_status
take_constant(work *k, powers *s, qdot_expr *constant)
{
    *constant = QDOT_ZERO;
    QDOT_TRY(drop_zeros(k, s));
    if (leading(s).n < 0 || (!s->exact && s->end.n <= 0))
        return QDOT_EFAILED;
    if (s->terms.n > 0 && s->terms.at[0].q.n == 0) {
        *constant = s->terms.at[0].c;
        for (size_t i = 1; i < s->terms.n; i++)
            s->terms.at[i - 1] = s->terms.at[i];
        s->terms.n--;
    }
    return QDOT_OK;
}

/* s = f(s) by Taylor's series about the term of order 0. */
static qdot_status
apply_analytic(work *k, qdot_fun_id f, powers *s)
{
    qdot_pool *pool = k->x->pool;
    struct coefficients c = {.pool = pool, .z = qdot_symbol_get(pool, QDOT_FORMAL, "a place")};
    powers made = {0};
    qdot_status status = take_constant(k, s, &c.at);

    c.at = qdot_simplify(pool, c.at, k->x->facts); /* an end of the domain of f may stand in disguise */
    c.f = qdot_fun1(pool, f, c.z);
    if (status == QDOT_OK)
        status = drop_zeros(k, s);
    if (status == QDOT_OK)
        status = compose(k, s, taylor_coefficient, &c, &made);
    powers_clear(s);
    *s = made;
    return status;
}

/* f(u) by functions that have an expansion where f has no Taylor series; nil: none is known. */
static qdot_expr
rewritten(qdot_pool *pool, qdot_fun_id f, qdot_expr u)
{
    const qdot_expr half = qdot_mul(pool, QDOT_HALF, QDOT_PI), u2 = qdot_pow_int(pool, u, 2);
    qdot_expr v;

    switch (f) {
    case QDOT_TAN: return qdot_div(pool, qdot_fun1(pool, QDOT_SIN, u), qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COT: return qdot_div(pool, qdot_fun1(pool, QDOT_COS, u), qdot_fun1(pool, QDOT_SIN, u));
    case QDOT_SEC: return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_CSC: return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_SIN, u));
    case QDOT_ASINH: return qdot_fun1(pool, QDOT_LOG, qdot_add(pool, u, qdot_sqrt(pool, qdot_add(pool, u2, QDOT_ONE))));
    case QDOT_ACOSH: return qdot_fun1(pool, QDOT_LOG, qdot_add(pool, u, qdot_sqrt(pool, qdot_sub(pool, u2, QDOT_ONE))));
    case QDOT_ATANH:
        return qdot_mul(pool, QDOT_HALF,
                        qdot_fun1(pool, QDOT_LOG, qdot_div(pool, qdot_add(pool, QDOT_ONE, u), qdot_sub(pool, QDOT_ONE, u))));
    case QDOT_ASIN: /* asin u = 2 atan(u/(1 + sqrt(1 - u^2))) */
    case QDOT_ACOS:
        v = qdot_add(pool, QDOT_ONE, qdot_sqrt(pool, qdot_sub(pool, QDOT_ONE, u2)));
        v = qdot_mul(pool, qdot_expr_int(pool, 2), qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, u, v)));
        return f == QDOT_ASIN ? v : qdot_sub(pool, half, v);
    default: return QDOT_NIL;
    }
}

/* atan u = +-pi/2 - atan(1/u) where u grows. */
static qdot_status
expand_large_arctangent(work *k, qdot_expr u, int sign, powers *s)
{
    qdot_pool *pool = k->x->pool;
    const qdot_expr half = qdot_mul(pool, qdot_expr_ratio(pool, sign, 2), QDOT_PI);

    QDOT_TRY(expand(k, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, QDOT_ONE, u)), s));
    for (size_t i = 0; i < s->terms.n; i++)
        s->terms.at[i].c = qdot_neg(pool, s->terms.at[i].c);
    return put_term(pool, s, (ratio){0, 1}, half);
}

static qdot_status
expand_function(work *k, qdot_expr e, powers *s)
{
    qdot_pool *pool = k->x->pool;
    const qdot_fun_id f = (qdot_fun_id)qdot_expr_node(pool, e)->op;
    const qdot_expr u = qdot_expr_arg(pool, e, 0);
    qdot_expr other;
    qdot_status status;

    if (qdot_expr_count(pool, e) != 1)
        return QDOT_EFAILED;
    QDOT_TRY(expand(k, u, s));
    if (f == QDOT_LOG)
        return take_logarithm(k, s);
    if (f == QDOT_ATAN && drop_zeros(k, s) == QDOT_OK && s->terms.n > 0 && s->terms.at[0].q.n < 0) {
        const int sign = qdot_proved_sign(pool, s->terms.at[0].c, k->x->facts);

        powers_clear(s);
        return sign == 1 || sign == -1 ? expand_large_arctangent(k, u, sign, s) : QDOT_EFAILED;
    }
    status = apply_analytic(k, f, s);
    if (status != QDOT_EFAILED && status != QDOT_EDOMAIN)
        return status;
    other = rewritten(pool, f, u);
    powers_clear(s);
    return other == QDOT_NIL || other == e ? QDOT_EFAILED : expand(k, other, s);
}

/* b^p = exp(p log b) for a p that is no number. */
static qdot_status
expand_general_power(work *k, qdot_expr b, qdot_expr p, powers *s)
{
    powers exponent = {0};
    qdot_status status = expand(k, b, s);

    if (status == QDOT_OK)
        status = take_logarithm(k, s);
    if (status == QDOT_OK)
        status = expand(k, p, &exponent);
    if (status == QDOT_OK)
        status = multiply_powers(k, s, &exponent);
    powers_clear(&exponent);
    return status == QDOT_OK ? apply_analytic(k, QDOT_EXP, s) : status;
}

static qdot_status
expand_product(work *k, qdot_expr e, powers *s)
{
    qdot_pool *pool = k->x->pool;
    const uint32_t n = qdot_expr_count(pool, e);
    qdot_expr outside = qdot_expr_arg(pool, e, 0);
    qdot_status status;

    *s = (powers){.exact = true};
    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);

        if (!qdot_expr_contains(pool, b, k->x->w) && !qdot_expr_contains(pool, p, k->x->w))
            outside = qdot_mul(pool, outside, qdot_pow(pool, b, p));
    }
    status = put_term(pool, s, (ratio){0, 1}, outside);
    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        const fmpq *number = qdot_expr_rational(pool, p);
        powers part = {0};

        if (!qdot_expr_contains(pool, b, k->x->w) && !qdot_expr_contains(pool, p, k->x->w))
            continue;
        if (number == NULL) {
            status = expand_general_power(k, b, p, &part);
        } else {
            fmpq_t copy;

            fmpq_init(copy);
            fmpq_set(copy, number); /* the pool may move */
            status = expand(k, b, &part);
            if (status == QDOT_OK && !fmpq_is_one(copy))
                status = raise_to(k, &part, copy);
            fmpq_clear(copy);
        }
        if (status == QDOT_OK)
            status = multiply_powers(k, s, &part);
        powers_clear(&part);
    }
    return status;
}

static qdot_status
expand_sum(work *k, qdot_expr e, powers *s)
{
    qdot_pool *pool = k->x->pool;
    qdot_status status;

    *s = (powers){.exact = true};
    status = put_term(pool, s, (ratio){0, 1}, qdot_expr_arg(pool, e, 0));
    for (uint32_t i = 1; i < qdot_expr_count(pool, e) && status == QDOT_OK; i += 2) {
        powers part = {0};
        const qdot_expr factor = qdot_expr_arg(pool, e, i + 1);

        status = expand(k, qdot_expr_arg(pool, e, i), &part);
        if (status == QDOT_OK)
            status = add_powers(pool, s, &part, factor);
        powers_clear(&part);
    }
    return status;
}

static qdot_status
expand(work *k, qdot_expr e, powers *s)
{
    qdot_pool *pool = k->x->pool;
    qdot_status status;

    *s = (powers){.exact = true};
    if (e == QDOT_NIL)
        return QDOT_EFAILED;
    QDOT_TRY(qdot_interrupt_check());
    if (e == k->x->w)
        return put_term(pool, s, (ratio){1, 1}, QDOT_ONE);
    if (!qdot_expr_contains(pool, e, k->x->w))
        return put_term(pool, s, (ratio){0, 1}, e);
    if (k->depth >= MOST_DEPTH)
        return QDOT_EFAILED;
    k->depth++;
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_SUM: status = expand_sum(k, e, s); break;
    case QDOT_PROD: status = expand_product(k, e, s); break;
    case QDOT_FUN: status = expand_function(k, e, s); break;
    default: status = QDOT_EFAILED;
    }
    k->depth--;
    if (status != QDOT_OK)
        powers_clear(s);
    return status;
}

qdot_status
qdot_expansion_lead(qdot_expansion *x, qdot_expr e, qdot_expr *coefficient, int64_t *numerator, int64_t *denominator)
{
    qdot_status status = QDOT_EFAILED;

    for (int64_t span = 2; span <= MOST_SPAN && status == QDOT_EFAILED && !x->undefined; span += span < 4 ? 2 : 4) {
        work k = {.x = x, .span = {span, 1}};
        powers s = {0};

        status = expand(&k, e, &s);
        if (status == QDOT_OK)
            status = drop_zeros(&k, &s);
        if (status == QDOT_OK && s.terms.n == 0 && !s.exact)
            status = QDOT_EFAILED; /* all that was computed cancels */
        if (status == QDOT_OK) {
            *coefficient = s.terms.n > 0 ? s.terms.at[0].c : QDOT_ZERO;
            *numerator = s.terms.n > 0 ? s.terms.at[0].q.n : 0;
            *denominator = s.terms.n > 0 ? s.terms.at[0].q.d : 1;
        }
        powers_clear(&s);
        if (status == QDOT_EDOMAIN)
            status = QDOT_EFAILED;
        if (qdot_grave(status) != QDOT_OK)
            return status;
    }
    return status;
}
