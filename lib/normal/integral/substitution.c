/* substitution.c -- integrates f(u) u' over u, and rational functions of exponentials and of roots over these. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"
#include "normal/integral/polynomial.h"
#include "normal/integral/rational.h"

/* --- f(u) u' ------------------------------------------------------------------------- */

/* int term dx = int term/u' du where that holds x by u only. */
static qdot_expr
substitute_part(qdot_integral_task *t, qdot_expr term, qdot_expr u, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr slope = qdot_diff(pool, u, x), f, w;

    if (u == x || slope == QDOT_NIL || slope == QDOT_ZERO || !qdot_integral_goes(t))
        return QDOT_NIL;
    w = qdot_integral_variable(t, (qdot_expr_sign(pool, u) & QDOT_POS) == QDOT_POS);
    f = qdot_subs(pool, qdot_div(pool, term, slope), 1, &u, &w);
    if (f == QDOT_NIL)
        return f;
    if (qdot_expr_contains(pool, f, x)) {
        f = qdot_subs(pool, qdot_integral_normal(t, qdot_div(pool, term, slope)), 1, &u, &w);
        if (f == QDOT_NIL || qdot_expr_contains(pool, f, x))
            return QDOT_NIL;
    }
    f = qdot_integral_any(t, f, w, depth + 1);
    return f == QDOT_NIL ? f : qdot_subs(pool, f, 1, &w, &u);
}

/* Whether a power of w that is no integer occurs. */
static bool
holds_root_of(qdot_pool *pool, qdot_expr e, qdot_expr w)
{
    bool found = false;
    qdot_walk walk;

    if (qdot_walk_begin(pool, e, &walk) != QDOT_OK)
        return true;
    for (size_t i = 0; i < walk.n && !found; i++)
        if (qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD)
            for (uint32_t k = 1; k < qdot_expr_count(pool, walk.at[i]) && !found; k += 2) {
                int64_t n;

                found = qdot_expr_arg(pool, walk.at[i], k) == w &&
                        !qdot_expr_to_int(pool, qdot_expr_arg(pool, walk.at[i], k + 1), &n);
            }
    qdot_walk_end(&walk);
    return found;
}

/* --- powers, roots and logarithms as new variables -------------------------------------- */

/* int e dx over w = x^k, where e/x^(k - 1) holds x by x^k only. */
static qdot_expr
substitute_power(qdot_integral_task *t, qdot_expr e, qdot_expr x, int64_t k, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr w = qdot_integral_variable(t, true), v = qdot_integral_variable(t, true), root, f, F, xk = qdot_pow_int(pool, x, k);

    /* with v > 0 for x, and w for v^k, nothing but powers of v^k may be left */
    f = qdot_div(pool, e, qdot_mul(pool, qdot_expr_int(pool, k), qdot_pow_int(pool, x, k - 1)));
    root = qdot_pow(pool, w, qdot_expr_ratio(pool, 1, k));
    e = qdot_subs(pool, f, 1, &x, &v);
    f = qdot_subs(pool, e, 1, &v, &root);
    if (f != QDOT_NIL && holds_root_of(pool, f, w))
        f = qdot_integral_normal(t, qdot_subs(pool, qdot_integral_normal(t, e), 1, &v, &root));
    if (f == QDOT_NIL || holds_root_of(pool, f, w))
        return QDOT_NIL;
    F = qdot_integral_any(t, f, w, depth + 1);
    return F == QDOT_NIL ? F : qdot_subs(pool, F, 1, &w, &xk);
}

/* Read q = (a x + b)/(c x + d). */
static bool
read_linear_fraction(qdot_integral_task *t, qdot_expr q, qdot_expr x, qdot_poly *over, qdot_poly *under)
{
    qdot_reading r;

    if (!qdot_reading_make(t, q, x, &r) || r.n > 0 || r.factors > 1 || (r.factors == 1 && r.factor[0].power > 1))
        return false;
    *over = qdot_poly_read(t, qdot_mul(t->pool, r.rest, r.numerator), x);
    *under = qdot_poly_read(t, qdot_reading_denominator(t, &r), x);
    return over->degree <= 1 && under->degree <= 1 && over->degree >= 0 && under->degree >= 0 &&
           over->degree + under->degree > 0;
}

/* x as a function of w, from w^q = (a x + b)/(c x + d). */
static qdot_expr
solve_linear_fraction(qdot_pool *pool, const qdot_poly *over, const qdot_poly *under, qdot_expr wq)
{
    qdot_expr a = qdot_poly_coefficient(over, 1), b = qdot_poly_coefficient(over, 0);
    qdot_expr c = qdot_poly_coefficient(under, 1), d = qdot_poly_coefficient(under, 0);

    return qdot_div(pool, qdot_sub(pool, b, qdot_mul(pool, d, wq)), qdot_sub(pool, qdot_mul(pool, c, wq), a));
}

/* int e dx over w, x put in as a function of w: the root w = base^(1/q) of (a x + b)/(c x + d), or for q = 0 its logarithm. */
static qdot_expr
substitute_inverse(qdot_integral_task *t, qdot_expr e, qdot_expr base, int64_t q, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr w, u, of_w, X, f, F;
    qdot_poly over, under;

    if (!read_linear_fraction(t, base, x, &over, &under))
        return QDOT_NIL;
    w = qdot_integral_variable(t, q > 0);
    u = q == 0 ? qdot_fun1(pool, QDOT_LOG, base) : qdot_pow(pool, base, qdot_expr_ratio(pool, 1, q));
    of_w = q == 0 ? qdot_fun1(pool, QDOT_EXP, w) : qdot_pow_int(pool, w, q);
    X = solve_linear_fraction(pool, &over, &under, of_w);
    f = qdot_subs(pool, q == 0 ? qdot_subs(pool, e, 1, &u, &w) : e, 1, &base, &of_w);
    f = qdot_mul(pool, qdot_subs(pool, f, 1, &x, &X), qdot_diff(pool, X, w));
    F = qdot_integral_any(t, f, w, depth + 1);
    return F == QDOT_NIL ? F : qdot_subs(pool, F, 1, &w, &u);
}

/* The same over each root and logarithm that the node `at` of the integrand e is or holds as a factor. */
static qdot_expr
substitute_inverses(qdot_integral_task *t, qdot_expr e, qdot_expr at, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    qdot_expr F = QDOT_NIL;

    if (qdot_expr_is_function(pool, at, QDOT_LOG))
        return substitute_inverse(t, e, qdot_expr_arg(pool, at, 0), 0, x, depth);
    for (uint32_t k = 1; qdot_expr_kind(pool, at) == QDOT_PROD && k < qdot_expr_count(pool, at) && F == QDOT_NIL && !t->failed; k += 2) {
        const fmpq *exponent = qdot_expr_rational(pool, qdot_expr_arg(pool, at, k + 1));

        if (exponent != NULL && !fmpz_is_one(fmpq_denref(exponent)) && fmpz_cmp_si(fmpq_denref(exponent), 6) <= 0)
            F = substitute_inverse(t, e, qdot_expr_arg(pool, at, k), fmpz_get_si(fmpq_denref(exponent)), x, depth);
    }
    return F;
}

/* int e dx over w = exp(u), with exp(k u) as w^k. */
static qdot_expr
substitute_exponential(qdot_integral_task *t, qdot_expr e, qdot_expr u, qdot_expr x, int depth)
{
    enum { MOST = 4 };
    qdot_pool *pool = t->pool;
    qdot_expr w, from[2 * MOST], to[2 * MOST], v = qdot_expr_arg(pool, u, 0), slope = qdot_integral_slope(pool, v, x), f, F;

    if (slope == QDOT_NIL || slope == QDOT_ZERO)
        return QDOT_NIL;
    w = qdot_integral_variable(t, true);
    for (int64_t k = 1; k <= MOST; k++)
        for (int i = 0; i < 2; i++) {
            int64_t n = i == 0 ? k : -k;

            from[2 * (k - 1) + i] = qdot_fun1(pool, QDOT_EXP, qdot_mul(pool, qdot_expr_int(pool, n), v));
            to[2 * (k - 1) + i] = qdot_pow_int(pool, w, n);
        }
    f = qdot_div(pool, qdot_subs(pool, e, 2 * MOST, from, to), qdot_mul(pool, slope, w));
    if (f == QDOT_NIL || qdot_expr_contains(pool, f, x))
        return QDOT_NIL;
    F = qdot_integral_any(t, f, w, depth + 1);
    return F == QDOT_NIL ? F : qdot_subs(pool, F, 1, &w, &u);
}

qdot_expr
qdot_substitution_integrate(qdot_integral_task *t, qdot_expr term, qdot_expr x, int depth)
{
    enum { MOST = 12 };
    qdot_expr tried[MOST], F = QDOT_NIL;
    size_t n = 0;
    qdot_walk w;

    if (depth > 3 || qdot_walk_begin(t->pool, term, &w) != QDOT_OK)
        return QDOT_NIL;
    for (size_t i = w.n; i-- > 0 && n < MOST;) { /* the outer parts first */
        qdot_expr e = w.at[i];

        if (e == term || e == x || !qdot_expr_is_scalar(t->pool, e) || !qdot_expr_contains(t->pool, e, x))
            continue;
        tried[n++] = e;
    }
    qdot_walk_end(&w);
    for (size_t i = 0; i < n && F == QDOT_NIL && !t->failed; i++)
        F = substitute_part(t, term, tried[i], x, depth);
    if (F == QDOT_NIL && !t->failed && depth <= 1)
        F = substitute_inverses(t, term, term, x, depth);
    for (size_t i = 0; i < n && F == QDOT_NIL && !t->failed && depth <= 1; i++)
        F = qdot_expr_is_function(t->pool, tried[i], QDOT_EXP) ? substitute_exponential(t, term, tried[i], x, depth)
                                                               : substitute_inverses(t, term, tried[i], x, depth);
    for (int64_t k = 4; k >= 2 && F == QDOT_NIL && !t->failed && depth <= 1 && qdot_expr_contains(t->pool, term, x); k--)
        F = substitute_power(t, term, x, k, depth);
    return F;
}

/* --- exponentials -------------------------------------------------------------------- */

qdot_expr
qdot_exponential_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr w, e, slope;

    if (r->bare || r->n != 1 || r->generator[0].kind != QDOT_GEN_EXP)
        return QDOT_NIL;
    slope = qdot_integral_slope(pool, r->generator[0].of, x);
    if (slope == QDOT_NIL)
        return QDOT_NIL;
    w = qdot_integral_variable(t, true);
    e = qdot_div(pool, qdot_mul(pool, r->rest, r->numerator), qdot_mul(pool, qdot_reading_denominator(t, r), slope));
    e = qdot_subs(pool, e, 1, &r->generator[0].symbol, &w);
    return qdot_rational_over(t, qdot_div(pool, e, w), w, r->generator[0].expr);
}

/* --- roots of (a x + b)/(c x + d) ---------------------------------------------------- */

qdot_expr
qdot_linear_root_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    int at = -1;
    qdot_poly over, under;
    qdot_expr w, wq, X, e, F, from[QDOT_READING_GENERATORS + 1], to[QDOT_READING_GENERATORS + 1];

    for (int i = 0; i < r->n; i++) {
        /* a root of higher degree goes first: sqrt(16 - x^4) is sqrt(2 - x) times that of a cubic where x > 0 */
        if (r->generator[i].kind != QDOT_GEN_ROOT || qdot_poly_read(t, r->generator[i].of, x).degree > 1)
            return QDOT_NIL;
        if ((at < 0 || r->generator[i].order > r->generator[at].order) &&
            read_linear_fraction(t, r->generator[i].of, x, &over, &under))
            at = i;
    }
    if (at < 0 || depth > 3 || !read_linear_fraction(t, r->generator[at].of, x, &over, &under))
        return QDOT_NIL;
    w = qdot_integral_variable(t, true);
    wq = qdot_pow_int(pool, w, r->generator[at].order);
    X = solve_linear_fraction(pool, &over, &under, wq);
    for (int i = 0; i < r->n; i++) {
        from[i] = r->generator[i].symbol;
        to[i] = i == at ? w : qdot_subs(pool, r->generator[i].expr, 1, &x, &X);
    }
    from[r->n] = x;
    to[r->n] = X;
    e = qdot_div(pool, qdot_mul(pool, r->rest, r->numerator), qdot_reading_denominator(t, r));
    e = qdot_mul(pool, qdot_subs(pool, e, (size_t)r->n + 1, from, to), qdot_diff(pool, X, w));
    F = qdot_integral_any(t, qdot_integral_normal(t, e), w, depth + 1);
    return F == QDOT_NIL ? F : qdot_subs(pool, F, 1, &w, &r->generator[at].expr);
}
