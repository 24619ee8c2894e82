/* logistic.c -- rewrites quotients by sums of exponentials as exponentials of logarithms, so that
 * none overflows. */
#include "tape/logistic.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"

enum { MOST = 8 }; /* largest number of factors in a product that is rewritten */

static bool
is_exp_or_hyperbolic(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function(pool, e, QDOT_EXP) || qdot_expr_is_function(pool, e, QDOT_COSH) ||
           qdot_expr_is_function(pool, e, QDOT_SINH);
}

static bool
has_sign_flags(const qdot_pool *pool, qdot_expr e, int sign)
{
    return (qdot_expr_node(pool, e)->sign & sign) == sign;
}

/* --- sums of two exponentials ---------------------------------------------------------- */

/* An exponential c e^v, with a number c and an expression v. */
typedef struct {
    qdot_expr c, v;
} exponential;

/* Read e as a constant c or as c e^v; false if it is neither. */
static bool
read_exponential(qdot_pool *pool, qdot_expr e, exponential *x)
{
    *x = (exponential){e, QDOT_ZERO};
    if (qdot_expr_is_constant(pool, e))
        return true;
    if (qdot_expr_is_function(pool, e, QDOT_EXP)) {
        *x = (exponential){QDOT_ONE, qdot_expr_arg(pool, e, 0)};
        return true;
    }
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i);

        if (qdot_expr_is_function(pool, base, QDOT_EXP) && qdot_expr_arg(pool, e, i + 1) == QDOT_ONE &&
            x->v == QDOT_ZERO)
            x->v = qdot_expr_arg(pool, base, 0);
        else if (!qdot_expr_is_constant(pool, base) ||
                 !qdot_expr_is_constant(pool, qdot_expr_arg(pool, e, i + 1)))
            return false;
    }
    x->c = qdot_div(pool, e, qdot_fun1(pool, QDOT_EXP, x->v));
    return x->v != QDOT_ZERO && x->c != QDOT_NIL;
}

/* A factor (c (e^v + ratio e^w))^-n e^(b (d + log ratio)), where d = w - v. */
typedef struct {
    qdot_expr c, v, w, ratio, d;
    qdot_expr n, b;
} denominator;

/* Read e as a sum c_1 e^v + c_2 e^w with c_1 c_2 > 0; -1 is factored out only if n is an integer. */
static bool
read_sum_of_exponentials(qdot_pool *pool, qdot_expr e, denominator *x)
{
    exponential terms[2];
    size_t count = 0;

    if (qdot_expr_is_constant(pool, e))
        return false;
    if (qdot_expr_is_function(pool, e, QDOT_COSH)) {
        const qdot_expr u = qdot_expr_arg(pool, e, 0);

        *x = (denominator){.c = QDOT_HALF, .v = qdot_neg(pool, u), .w = u, .ratio = QDOT_ONE};
        return true;
    }
    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return false;
    if (qdot_expr_arg(pool, e, 0) != QDOT_ZERO)
        terms[count++] = (exponential){qdot_expr_arg(pool, e, 0), QDOT_ZERO};
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr term =
            qdot_mul(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1));

        if (count == 2 || term == QDOT_NIL || !read_exponential(pool, term, &terms[count++]))
            return false;
    }
    if (count < 2 || terms[0].v == terms[1].v)
        return false;
    *x = (denominator){.c = terms[0].c,
                       .v = terms[0].v,
                       .w = terms[1].v,
                       .ratio = qdot_div(pool, terms[1].c, terms[0].c)};
    return x->ratio != QDOT_NIL && has_sign_flags(pool, x->ratio, QDOT_POS);
}

/* The quotient a/b if it is a rational number; else nil. */
static qdot_expr
rational_quotient(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr term, q;

    if (a == QDOT_ZERO)
        return QDOT_ZERO;
    q = qdot_div(pool, a, b);
    if (q != QDOT_NIL && qdot_expr_kind(pool, q) == QDOT_NUM)
        return q;
    if (qdot_expr_kind(pool, a) != QDOT_SUM || qdot_expr_kind(pool, b) != QDOT_SUM)
        return QDOT_NIL;
    term = qdot_mul(pool, qdot_expr_arg(pool, a, 1), qdot_expr_arg(pool, a, 2));
    q = qdot_div(pool, term, qdot_mul(pool, qdot_expr_arg(pool, b, 1), qdot_expr_arg(pool, b, 2)));
    if (q == QDOT_NIL || qdot_expr_kind(pool, q) != QDOT_NUM)
        return QDOT_NIL;
    return qdot_expand(pool, qdot_sub(pool, a, qdot_mul(pool, q, b))) == QDOT_ZERO ? q : QDOT_NIL;
}

/* The exponent b + r, limited to the range -n/2 ... n/2 in which the factor stays finite. */
static qdot_expr
limited_exponent(qdot_pool *pool, const denominator *x, qdot_expr r)
{
    const qdot_expr half = qdot_mul(pool, QDOT_HALF, x->n), b = qdot_add(pool, x->b, r);

    if (qdot_expr_is_negative(pool, qdot_sub(pool, half, b)))
        return half;
    return qdot_expr_is_negative(pool, qdot_add(pool, half, b)) ? qdot_neg(pool, half) : b;
}

/* Move as much as possible of the factor e^*left into the denominator x. */
static void
move_exponential_into(qdot_pool *pool, denominator *x, qdot_expr *left)
{
    const qdot_expr r = rational_quotient(pool, *left, x->d);
    qdot_expr b;

    if (r == QDOT_NIL || r == QDOT_ZERO)
        return;
    b = limited_exponent(pool, x, r);
    *left = qdot_sub(pool, *left, qdot_mul(pool, qdot_sub(pool, b, x->b), x->d));
    x->b = b;
}

/* The function log(1 + e^d) (softplus) as a single function of d. */
static qdot_expr
softplus_of(qdot_pool *pool, qdot_expr d)
{
    const qdot_expr e = qdot_fun1(pool, QDOT_EXP, d);

    return qdot_hold(pool, qdot_fun1(pool, QDOT_LOG, qdot_add(pool, QDOT_ONE, e)));
}

/* The exponent -(n/2 - b) l(d) - (n/2 + b) l(-d), where l(d) = log(1 + e^d) and d includes log(ratio). */
static qdot_expr
exponent_of_denominator(qdot_pool *pool, const denominator *x)
{
    const qdot_expr half = qdot_mul(pool, QDOT_HALF, x->n);
    const qdot_expr d = qdot_add(pool, x->d, qdot_fun1(pool, QDOT_LOG, x->ratio));
    const qdot_expr up = qdot_sub(pool, half, x->b), down = qdot_add(pool, half, x->b);
    qdot_expr sum = QDOT_ZERO;

    if (up != QDOT_ZERO)
        sum = qdot_mul(pool, up, softplus_of(pool, d));
    if (down != QDOT_ZERO)
        sum = qdot_add(pool, sum, qdot_mul(pool, down, softplus_of(pool, qdot_neg(pool, d))));
    return qdot_neg(pool, sum);
}

/* --- quotients in products ---------------------------------------------------------------- */

typedef struct {
    qdot_pool *pool;
    qdot_expr rest; /* product of the factors that are not rewritten */
    qdot_expr left; /* product of the exponentials is e^left */
    qdot_expr sum;  /* a sum of exponentials in the denominator; nil: none */
    qdot_expr from; /* the factor of the product from which these parts were read */
    denominator under[MOST];
    size_t n;
} quotients;

static bool
is_negative_number(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_NUM && qdot_expr_is_negative(pool, e);
}

/* Whether b^p has the form (c_1 e^v + c_2 e^w)^-n; if so, record it as a denominator. */
static bool
record_denominator(quotients *q, qdot_expr b, qdot_expr p)
{
    qdot_pool *pool = q->pool;
    denominator *x = &q->under[q->n];
    qdot_expr own;
    int64_t whole;

    if (q->n == MOST || !is_negative_number(pool, p) || !read_sum_of_exponentials(pool, b, x) ||
        !(has_sign_flags(pool, x->c, QDOT_POS) || qdot_expr_to_int(pool, p, &whole)))
        return false;
    x->n = qdot_neg(pool, p);
    x->b = QDOT_ZERO;
    x->d = qdot_expand(pool, qdot_sub(pool, x->w, x->v));
    q->rest = qdot_mul(pool, q->rest, qdot_pow(pool, x->c, p));
    own = qdot_mul(pool, qdot_mul(pool, QDOT_HALF, p), qdot_add(pool, x->v, x->w));
    own = qdot_expand(pool, own);
    if (own == QDOT_NIL)
        return true;
    move_exponential_into(pool, x, &own);
    q->left = qdot_add(pool, q->left, own);
    q->n++;
    return true;
}

/* Replace cosh(u)^p sinh(u)^r, with p + r <= 0 and one negative exponent, by tanh(u)^r cosh(u)^(p + r). */
static qdot_expr
replace_by_tanh(qdot_pool *pool, qdot_expr e)
{
    qdot_expr f = e;

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e) && f != QDOT_NIL; i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), r = qdot_expr_arg(pool, e, i + 1);
        qdot_expr c, p = QDOT_ZERO, all;

        if (!qdot_expr_is_function(pool, b, QDOT_SINH) || qdot_expr_kind(pool, r) != QDOT_NUM)
            continue;
        c = qdot_fun1(pool, QDOT_COSH, qdot_expr_arg(pool, b, 0));
        for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, e); k += 2)
            if (qdot_expr_arg(pool, e, k) == c)
                p = qdot_expr_arg(pool, e, k + 1);
        all = qdot_add(pool, p, r);
        if (qdot_expr_kind(pool, all) != QDOT_NUM ||
            (all != QDOT_ZERO && !qdot_expr_is_negative(pool, all)))
            continue;
        f = qdot_div(pool, f, qdot_mul(pool, qdot_pow(pool, b, r), qdot_pow(pool, c, p)));
        f = qdot_mul(pool, f, qdot_pow(pool, qdot_fun1(pool, QDOT_TANH, qdot_expr_arg(pool, b, 0)), r));
        f = qdot_mul(pool, f, qdot_pow(pool, c, all));
    }
    return f;
}

static qdot_expr rewrite_product(qdot_pool *pool, qdot_expr e, void *user);

/* A term c cosh(u)^a sinh(u)^b with a, b >= 0; u nil: the constant c. */
typedef struct {
    qdot_expr c, u;
    int64_t a, b;
} cosines;

/* Whether base^exponent is a power k > 0 of cosh(u) or sinh(u) with the u of t; then k is added to t. */
static bool
add_hyperbolic_power(qdot_pool *pool, qdot_expr base, qdot_expr exponent, cosines *t)
{
    const bool cosine = qdot_expr_is_function(pool, base, QDOT_COSH);
    int64_t k;

    if ((!cosine && !qdot_expr_is_function(pool, base, QDOT_SINH)) || !qdot_expr_to_int(pool, exponent, &k) ||
        k < 1 || (t->u != QDOT_NIL && t->u != qdot_expr_arg(pool, base, 0)))
        return false;
    t->u = qdot_expr_arg(pool, base, 0);
    *(cosine ? &t->a : &t->b) += k;
    return true;
}

static bool
read_hyperbolic_term(qdot_pool *pool, qdot_expr x, cosines *t)
{
    *t = (cosines){.c = x, .u = QDOT_NIL};
    if (qdot_expr_is_constant(pool, x))
        return true;
    t->c = QDOT_ONE;
    if (qdot_expr_kind(pool, x) != QDOT_PROD)
        return add_hyperbolic_power(pool, x, QDOT_ONE, t);
    t->c = qdot_expr_arg(pool, x, 0);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, x); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, x, i), k = qdot_expr_arg(pool, x, i + 1);

        if (qdot_expr_is_constant(pool, base) && qdot_expr_is_constant(pool, k))
            t->c = qdot_mul(pool, t->c, qdot_pow(pool, base, k));
        else if (!add_hyperbolic_power(pool, base, k, t))
            return false;
    }
    return t->c != QDOT_NIL;
}

/* A sum written as the product large * scaled, where large > 0 and `scaled` does not overflow. */
typedef struct {
    qdot_expr large, scaled;
} factored;

/* Write a polynomial of cosh(u) and sinh(u) as cosh(u)^N times terms in tanh(u) and 1/cosh(u);
 * whether it is one. */
static bool
factor_out_cosh(qdot_pool *pool, qdot_expr e, factored *f)
{
    const uint32_t n = qdot_expr_count(pool, e);
    qdot_expr u = QDOT_NIL, cosine, tangent;
    int64_t N = 0;
    cosines t;

    for (uint32_t i = 1; i + 1 < n; i += 2) {
        if (!read_hyperbolic_term(pool, qdot_expr_arg(pool, e, i), &t) ||
            (t.u != QDOT_NIL && u != QDOT_NIL && t.u != u))
            return false;
        u = t.u != QDOT_NIL ? t.u : u;
        N = t.a + t.b > N ? t.a + t.b : N;
    }
    if (u == QDOT_NIL)
        return false;
    cosine = qdot_fun1(pool, QDOT_COSH, u);
    tangent = qdot_fun1(pool, QDOT_TANH, u);
    f->large = qdot_pow_int(pool, cosine, N);
    f->scaled = qdot_mul(pool, qdot_expr_arg(pool, e, 0),
                         rewrite_product(pool, qdot_pow_int(pool, cosine, -N), NULL));
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr term;

        (void)read_hyperbolic_term(pool, qdot_expr_arg(pool, e, i), &t);
        term = rewrite_product(pool, qdot_mul(pool, t.c, qdot_pow_int(pool, cosine, t.a + t.b - N)), NULL);
        term = qdot_mul(pool, term, qdot_pow_int(pool, tangent, t.b));
        f->scaled = qdot_add(pool, f->scaled, qdot_mul(pool, qdot_expr_arg(pool, e, i + 1), term));
    }
    return f->scaled != QDOT_NIL;
}

/* Read term number i of a sum (0: its constant) as an exponential. */
static bool
read_term(qdot_pool *pool, qdot_expr e, uint32_t i, exponential *x)
{
    qdot_expr term = qdot_expr_arg(pool, e, 0);

    if (i > 0)
        term = qdot_mul(pool, qdot_expr_arg(pool, e, 2 * i - 1), qdot_expr_arg(pool, e, 2 * i));
    return term != QDOT_NIL && read_exponential(pool, term, x);
}

/* sum c_i e^(k_i u), k_i rational, as (e^(k u) + e^(K u)) (the terms over that), k and K the least and the
 * largest; whether it is one. */
static bool
factor_out_exponentials(qdot_pool *pool, qdot_expr e, factored *f)
{
    const uint32_t n = (qdot_expr_count(pool, e) + 1) / 2;
    qdot_expr u = QDOT_NIL, low = QDOT_NIL, high = QDOT_NIL, pair;
    exponential x;

    for (uint32_t i = qdot_expr_arg(pool, e, 0) == QDOT_ZERO; i < n; i++) {
        qdot_expr k;

        if (!read_term(pool, e, i, &x))
            return false;
        u = u == QDOT_NIL && x.v != QDOT_ZERO ? x.v : u;
        k = x.v == QDOT_ZERO ? QDOT_ZERO : rational_quotient(pool, x.v, u);
        if (k == QDOT_NIL)
            return false;
        if (low == QDOT_NIL || qdot_expr_is_negative(pool, qdot_sub(pool, k, low)))
            low = k;
        if (high == QDOT_NIL || qdot_expr_is_negative(pool, qdot_sub(pool, high, k)))
            high = k;
    }
    if (u == QDOT_NIL || low == high)
        return false;
    pair = qdot_add(pool, qdot_fun1(pool, QDOT_EXP, qdot_mul(pool, low, u)),
                    qdot_fun1(pool, QDOT_EXP, qdot_mul(pool, high, u)));
    f->large = pair;
    f->scaled = QDOT_ZERO;
    for (uint32_t i = qdot_expr_arg(pool, e, 0) == QDOT_ZERO; i < n; i++) {
        qdot_expr term;

        (void)read_term(pool, e, i, &x);
        term = qdot_mul(pool, x.c, qdot_fun1(pool, QDOT_EXP, x.v));
        f->scaled = qdot_add(pool, f->scaled, rewrite_product(pool, qdot_div(pool, term, pair), NULL));
    }
    return f->scaled != QDOT_NIL;
}

/* Factor out exponentials if e is a sum of them, except two of the same sign (read_sum_of_exponentials). */
static bool
factor_exponentials(qdot_pool *pool, qdot_expr e, factored *f)
{
    denominator x;

    return qdot_expr_kind(pool, e) == QDOT_SUM && !read_sum_of_exponentials(pool, e, &x) &&
           (factor_out_cosh(pool, e, f) || factor_out_exponentials(pool, e, f));
}

/* Replace negative powers of sums of exponentials by negative powers of their factors. */
static qdot_expr
factor_negative_powers(qdot_pool *pool, qdot_expr e)
{
    qdot_expr f = e;

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e) && f != QDOT_NIL; i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        factored by;

        if (!is_negative_number(pool, p) || !factor_exponentials(pool, b, &by))
            continue;
        f = qdot_div(pool, f, qdot_pow(pool, b, p));
        f = qdot_mul(pool, f, qdot_mul(pool, qdot_pow(pool, by.large, p),
                                       qdot_pow(pool, by.scaled, p)));
    }
    return f;
}

/* The sum b itself; for cosh(u), sinh(u) the sum (e^u +- e^-u)/2; nil for other expressions. */
static qdot_expr
write_as_sum(qdot_pool *pool, qdot_expr b)
{
    qdot_expr up, down;

    if (qdot_expr_kind(pool, b) == QDOT_SUM)
        return b;
    if (!qdot_expr_is_function(pool, b, QDOT_COSH) && !qdot_expr_is_function(pool, b, QDOT_SINH))
        return QDOT_NIL;
    up = qdot_fun1(pool, QDOT_EXP, qdot_expr_arg(pool, b, 0));
    down = qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_expr_arg(pool, b, 0)));
    if (qdot_expr_is_function(pool, b, QDOT_SINH))
        down = qdot_neg(pool, down);
    return qdot_add(pool, qdot_mul(pool, QDOT_HALF, up), qdot_mul(pool, QDOT_HALF, down));
}

/* Sort the factors of e into denominators, exponentials and remaining factors. */
static void
sort_factors(quotients *q, qdot_expr e)
{
    qdot_pool *pool = q->pool;

    q->rest = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e) && q->rest != QDOT_NIL; i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        qdot_expr sum;

        if (record_denominator(q, b, p))
            continue;
        if (qdot_expr_is_function(pool, b, QDOT_EXP) && p == QDOT_ONE)
            q->left = qdot_add(pool, q->left, qdot_expr_arg(pool, b, 0));
        else if (q->sum == QDOT_NIL && p == QDOT_ONE && (sum = write_as_sum(pool, b)) != QDOT_NIL) {
            q->sum = sum;
            q->from = b;
        } else
            q->rest = qdot_mul(pool, q->rest, qdot_pow(pool, b, p));
    }
}

/* Divide a sum that contains exponentials by the denominators, term by term. */
static qdot_expr
divide_terms(quotients *q, qdot_expr e)
{
    qdot_pool *pool = q->pool;
    const qdot_expr under = qdot_div(pool, e, q->from);
    qdot_expr sum = QDOT_ZERO, constant = qdot_expr_arg(pool, q->sum, 0);

    if (constant != QDOT_ZERO)
        sum = rewrite_product(pool, qdot_mul(pool, constant, under), NULL);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, q->sum); i += 2) {
        qdot_expr term =
            qdot_mul(pool, qdot_expr_arg(pool, q->sum, i), qdot_expr_arg(pool, q->sum, i + 1));

        term = rewrite_product(pool, qdot_mul(pool, term, under), NULL);
        if (term == QDOT_NIL || sum == QDOT_NIL)
            return QDOT_NIL;
        sum = qdot_add(pool, sum, term);
    }
    return sum;
}

/* Whether a term of a sum grows exponentially: e^v, cosh, sinh, or a product with one. */
static bool
grows_exponentially(const qdot_pool *pool, qdot_expr sum)
{
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, sum); i += 2) {
        const qdot_expr x = qdot_expr_arg(pool, sum, i);

        if (is_exp_or_hyperbolic(pool, x))
            return true;
        if (qdot_expr_kind(pool, x) != QDOT_PROD)
            continue;
        for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, x); k += 2) {
            const qdot_expr b = qdot_expr_arg(pool, x, k);

            if (is_exp_or_hyperbolic(pool, b))
                return true;
        }
    }
    return false;
}

/* Rewrite a product with sums of exponentials such that it does not overflow. */
static qdot_expr
rewrite_product(qdot_pool *pool, qdot_expr e, void *user)
{
    quotients q = {.pool = pool, .left = QDOT_ZERO, .sum = QDOT_NIL};
    qdot_expr exponent;

    (void)user;
    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_PROD)
        return e;
    e = factor_negative_powers(pool, e);
    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_PROD)
        return e;
    e = replace_by_tanh(pool, e);
    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_PROD)
        return e;
    sort_factors(&q, e);
    if (q.n == 0)
        return e;
    if (q.sum != QDOT_NIL && grows_exponentially(pool, q.sum))
        return divide_terms(&q, e);
    if (q.sum != QDOT_NIL)
        q.rest = qdot_mul(pool, q.rest, q.sum);
    for (size_t i = 0; i < q.n; i++)
        move_exponential_into(pool, &q.under[i], &q.left);
    exponent = q.left;
    for (size_t i = 0; i < q.n; i++) {
        const denominator *x = &q.under[i];
        const qdot_expr by = qdot_add(pool, x->b, qdot_mul(pool, QDOT_HALF, x->n));

        exponent = qdot_add(pool, exponent, exponent_of_denominator(pool, x));
        q.rest = qdot_mul(pool, q.rest, qdot_pow(pool, x->ratio, qdot_neg(pool, by)));
    }
    return qdot_mul(pool, q.rest, qdot_fun1(pool, QDOT_EXP, exponent));
}

/* Rewrite log(c_1 e^v + c_2 e^w) with c_1 and c_2 > 0. */
static qdot_expr
rewrite_logarithm_of_sum(qdot_pool *pool, const denominator *x)
{
    const qdot_expr d = qdot_expand(pool, qdot_sub(pool, x->w, x->v)),
                    at = qdot_add(pool, d, qdot_fun1(pool, QDOT_LOG, x->ratio));
    const qdot_expr minus = qdot_neg(pool, at), c = qdot_fun1(pool, QDOT_LOG, x->c);
    qdot_expr sum;

    if (x->v == QDOT_ZERO)
        return qdot_add(pool, c, softplus_of(pool, at));
    if (x->w == QDOT_ZERO)
        return qdot_add(pool, qdot_add(pool, c, qdot_fun1(pool, QDOT_LOG, x->ratio)),
                        softplus_of(pool, minus));
    sum = qdot_add(pool, softplus_of(pool, at), softplus_of(pool, minus));
    sum = qdot_add(pool, sum, qdot_fun1(pool, QDOT_LOG, x->ratio));
    sum = qdot_add(pool, sum, qdot_add(pool, x->v, x->w));
    return qdot_add(pool, c, qdot_mul(pool, QDOT_HALF, qdot_expand(pool, sum)));
}

/* Rewrite the logarithm of cosh(u)^N or of a sum of two exponentials such that it does not overflow. */
static qdot_expr
rewrite_logarithm_of_factor(qdot_pool *pool, qdot_expr large)
{
    const bool power = qdot_expr_kind(pool, large) == QDOT_PROD;
    const qdot_expr base = power ? qdot_expr_arg(pool, large, 1) : large,
                    N = power ? qdot_expr_arg(pool, large, 2) : QDOT_ONE;
    denominator x;

    return read_sum_of_exponentials(pool, base, &x) ? qdot_mul(pool, N, rewrite_logarithm_of_sum(pool, &x)) : QDOT_NIL;
}

/* Rewrite log(S), for sums S that grow exponentially and for cosh(u), such that it does not overflow. */
static qdot_expr
rewrite_logarithm(qdot_pool *pool, qdot_expr e, void *user)
{
    const bool is_log = qdot_expr_is_function(pool, e, QDOT_LOG);
    const qdot_expr S = is_log ? qdot_expr_arg(pool, e, 0) : e;
    denominator x;
    factored f;

    (void)user;
    if (!is_log || qdot_logistic_argument(pool, e) != QDOT_NIL)
        return e;
    if (read_sum_of_exponentials(pool, S, &x))
        return has_sign_flags(pool, x.c, QDOT_POS) ? rewrite_logarithm_of_sum(pool, &x) : e;
    if (!factor_exponentials(pool, S, &f))
        return e;
    return qdot_add(pool, rewrite_logarithm_of_factor(pool, f.large), qdot_fun1(pool, QDOT_LOG, f.scaled));
}

bool
qdot_logistic_occurs(const qdot_walk *w)
{
    bool any = false;

    for (size_t i = 0; i < w->n && !any; i++)
        any = is_exp_or_hyperbolic(w->pool, w->at[i]);
    return any;
}

qdot_expr
qdot_logistic_form(qdot_pool *pool, qdot_expr e)
{
    e = qdot_walk_replace(pool, e, QDOT_PROD, rewrite_product, NULL);
    return e == QDOT_NIL ? e : qdot_walk_replace(pool, e, QDOT_FUN, rewrite_logarithm, NULL);
}

qdot_expr
qdot_logistic_argument(const qdot_pool *pool, qdot_expr e)
{
    qdot_expr sum, x;

    if (!qdot_expr_is_function(pool, e, QDOT_LOG))
        return QDOT_NIL;
    sum = qdot_expr_arg(pool, e, 0);
    if (qdot_expr_kind(pool, sum) != QDOT_SUM || qdot_expr_count(pool, sum) != 3 ||
        qdot_expr_arg(pool, sum, 0) != QDOT_ONE || qdot_expr_arg(pool, sum, 2) != QDOT_ONE)
        return QDOT_NIL;
    x = qdot_expr_arg(pool, sum, 1);
    return qdot_expr_is_function(pool, x, QDOT_EXP) ? qdot_expr_arg(pool, x, 0) : QDOT_NIL;
}
