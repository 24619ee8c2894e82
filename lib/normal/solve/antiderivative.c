/* antiderivative.c -- integrates by a table, by parts and by substitution. */
#include "normal/solve/antiderivative.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* The deepest nesting of substitutions and integrations by parts; usual integrals need two. */
enum { MOST_DEPTH = 4 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
} table;

static qdot_expr integrate_expression(const table *t, qdot_expr e, qdot_expr x, int depth);

/* A term split into its factors that contain x, and the product of the other factors. */
typedef struct {
    qdot_expr rest;
    qdot_expr base[4], exponent[4];
    uint32_t n; /* number of factors that contain x; with more than 4 the term is not in the table */
} factors;

static factors
split_term(qdot_pool *pool, qdot_expr term, qdot_expr x)
{
    factors f = {.rest = term};
    uint32_t n = qdot_expr_count(pool, term);

    if (qdot_expr_kind(pool, term) != QDOT_PROD) {
        f.base[0] = term;
        f.exponent[0] = QDOT_ONE;
        f.rest = QDOT_ONE;
        f.n = 1;
        return f;
    }
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr b = qdot_expr_arg(pool, term, i), e = qdot_expr_arg(pool, term, i + 1);

        if (!qdot_expr_contains(pool, b, x) && !qdot_expr_contains(pool, e, x))
            continue;
        if (f.n++ >= 4)
            return f;
        f.base[f.n - 1] = b;
        f.exponent[f.n - 1] = e;
    }
    for (uint32_t i = 0; i < f.n; i++)
        f.rest = qdot_div(pool, f.rest, qdot_pow(pool, f.base[i], f.exponent[i]));
    return f;
}

/* The integral of u^n with respect to u. */
static qdot_expr
integrate_power(qdot_pool *pool, qdot_expr u, qdot_expr n)
{
    if (n == QDOT_MINUS_ONE)
        return qdot_fun1(pool, QDOT_LOG, u);
    n = qdot_add(pool, n, QDOT_ONE);
    return qdot_div(pool, qdot_pow(pool, u, n), n);
}

/* The integral of f(u) du; nil if the table does not have it. */
static qdot_expr
function(qdot_pool *pool, qdot_fun_id id, qdot_expr u)
{
    switch (id) {
    case QDOT_SIN:
        return qdot_neg(pool, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COS:
        return qdot_fun1(pool, QDOT_SIN, u);
    case QDOT_EXP:
        return qdot_fun1(pool, QDOT_EXP, u);
    case QDOT_SINH:
        return qdot_fun1(pool, QDOT_COSH, u);
    case QDOT_COSH:
        return qdot_fun1(pool, QDOT_SINH, u);
    case QDOT_TAN:
        u = qdot_fun1(pool, QDOT_COS, u);
        return qdot_neg(pool, integrate_power(pool, u, QDOT_MINUS_ONE));
    default:
        return QDOT_NIL;
    }
}

/* Integrate a single factor: a power of a linear function of x, or a function of one. */
static qdot_expr
integrate_factor(const table *t, qdot_expr base, qdot_expr exponent, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    bool fun = qdot_expr_kind(pool, base) == QDOT_FUN;
    qdot_expr inner = fun && exponent == QDOT_ONE && qdot_expr_count(pool, base) == 1
                          ? qdot_expr_arg(pool, base, 0)
                          : base;
    qdot_expr slope = qdot_diff(pool, inner, x), whole;

    if (slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_contains(pool, slope, x) ||
        qdot_expr_contains(pool, exponent, x))
        return QDOT_NIL;
    whole = inner != base
                ? function(pool, (qdot_fun_id)qdot_expr_node(pool, base)->op, inner)
                : integrate_power(pool, base, exponent);
    return whole == QDOT_NIL ? whole : qdot_div(pool, whole, slope);
}

/* Integrate x^n f(x) by parts for a small positive integer n: x^n F - int n x^(n-1) F dx with F' = f. */
static qdot_expr
integrate_by_parts(const table *t, const factors *f, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;

    for (uint32_t i = 0; i < f->n && f->n == 2; i++) {
        qdot_expr p, F, left;
        long n;

        if (f->base[i] != x || !qdot_expr_to_int(pool, f->exponent[i], &n) || n < 1 ||
            n > MOST_DEPTH)
            continue;
        F = integrate_factor(t, f->base[1 - i], f->exponent[1 - i], x);
        if (F == QDOT_NIL)
            return QDOT_NIL;
        p = qdot_pow_int(pool, x, n);
        left = integrate_expression(t, qdot_mul(pool, qdot_diff(pool, p, x), F), x, depth + 1);
        return left == QDOT_NIL ? left
                                : qdot_sub(pool, qdot_mul(pool, p, F), left);
    }
    return QDOT_NIL;
}

/* Substitute u for a subexpression of the term: int f(u) u' dx = int f(u) du. */
static qdot_expr
integrate_by_substitution(const table *t, qdot_expr term, qdot_expr u, qdot_expr x, int depth)
{
    static const char *const names[] = {"u#0", "u#1", "u#2", "u#3", "u#4"};
    qdot_pool *pool = t->pool;
    qdot_expr slope = qdot_diff(pool, u, x), f, w;

    if (u == x || slope == QDOT_NIL || slope == QDOT_ZERO)
        return QDOT_NIL;
    w = qdot_symbol_get(pool, QDOT_FORMAL, names[depth]);
    f = qdot_simplify(pool, qdot_div(pool, term, slope), t->facts);
    f = qdot_subs(pool, f, 1, &u, &w);
    if (f == QDOT_NIL || qdot_expr_contains(pool, f, x))
        return QDOT_NIL;
    f = integrate_expression(t, f, w, depth + 1);
    return f == QDOT_NIL ? f : qdot_subs(pool, f, 1, &w, &u);
}

static qdot_expr
integrate_term(const table *t, qdot_expr term, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr product = QDOT_ONE, F = QDOT_NIL;
    factors f;

    if (!qdot_expr_contains(pool, term, x))
        return qdot_mul(pool, term, x);
    f = split_term(pool, term, x);
    if (f.n == 0 || f.n > 4 || f.rest == QDOT_NIL)
        return QDOT_NIL;
    for (uint32_t i = 0; i < f.n; i++)
        product = qdot_mul(pool, product, qdot_pow(pool, f.base[i], f.exponent[i]));
    if (f.n == 1)
        F = integrate_factor(t, f.base[0], f.exponent[0], x);
    if (F == QDOT_NIL && depth < MOST_DEPTH)
        F = integrate_by_parts(t, &f, x, depth);
    for (uint32_t i = 0; i < f.n && F == QDOT_NIL && depth < MOST_DEPTH; i++) {
        F = integrate_by_substitution(t, product, f.base[i], x, depth);
        if (F == QDOT_NIL && qdot_expr_kind(pool, f.base[i]) == QDOT_FUN)
            F = integrate_by_substitution(t, product, qdot_expr_arg(pool, f.base[i], 0), x, depth);
    }
    return F == QDOT_NIL ? F : qdot_mul(pool, f.rest, F);
}

static qdot_expr
integrate_expression(const table *t, qdot_expr e, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr sum = QDOT_ZERO, whole;
    uint32_t n;

    if (e == QDOT_NIL)
        return e;
    if (qdot_expr_kind(pool, e) != QDOT_SUM) {
        whole = integrate_term(t, e, x, depth); /* try a single term as it is: (2 x + 3)^-2 must not be expanded */
        if (whole != QDOT_NIL)
            return whole;
    }
    e = qdot_expand(pool, e);
    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_SUM)
        return e == QDOT_NIL ? e : integrate_term(t, e, x, depth);
    n = qdot_expr_count(pool, e);
    for (uint32_t i = 0; i < n && sum != QDOT_NIL; i += i == 0 ? 1 : 2) {
        /* the arguments of a sum are its constant c0, then pairs of coefficient and term: c1, t1, c2, t2 ... */
        qdot_expr term = qdot_expr_arg(pool, e, i), part;

        if (i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, e, i + 1));
        part = integrate_term(t, term, x, depth);
        sum = part == QDOT_NIL ? QDOT_NIL : qdot_add(pool, sum, part);
    }
    return sum;
}

qdot_expr
qdot_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    table t = {pool, facts};

    return integrate_expression(&t, e, x, 0);
}

qdot_expr
qdot_potential_of(qdot_pool *pool, size_t n, const qdot_expr *x, const qdot_expr *a,
                  const qdot_facts *facts)
{
    qdot_expr F = QDOT_ZERO;

    for (size_t i = 0; i < n && F != QDOT_NIL; i++) {
        qdot_expr rest = qdot_sub(pool, a[i], qdot_diff(pool, F, x[i])), part;

        rest = qdot_simplify(pool, rest, facts);
        if (rest == QDOT_ZERO)
            continue;
        part = qdot_antiderivative(pool, rest, x[i], facts);
        F = part == QDOT_NIL ? QDOT_NIL : qdot_add(pool, F, part);
    }
    if (F == QDOT_NIL)
        return F;
    F = qdot_simplify(pool, F, facts);
    for (size_t i = 0; i < n && F != QDOT_NIL; i++)
        if (!qdot_is_zero(pool, qdot_sub(pool, a[i], qdot_diff(pool, F, x[i])), facts))
            return QDOT_NIL;
    return F;
}
