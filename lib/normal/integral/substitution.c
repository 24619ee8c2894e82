/* substitution.c -- integrates f(u) u' over u, and rational functions of exponentials and of roots over these. */
#include "expr/build.h"
#include "expr/calculus.h"
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
    return F;
}

/* --- exponentials -------------------------------------------------------------------- */

qdot_expr
qdot_exponential_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr w, e, slope;
    qdot_primitive f;

    if (r->bare || r->n != 1 || r->generator[0].kind != QDOT_GEN_EXP)
        return QDOT_NIL;
    slope = qdot_diff(pool, r->generator[0].of, x);
    if (slope == QDOT_NIL || qdot_expr_contains(pool, slope, x))
        return QDOT_NIL;
    w = qdot_integral_variable(t, true);
    e = qdot_div(pool, qdot_mul(pool, r->rest, r->numerator), qdot_mul(pool, qdot_reading_denominator(t, r), slope));
    e = qdot_subs(pool, e, 1, &r->generator[0].symbol, &w);
    if (!qdot_rational_integrate(t, qdot_div(pool, e, w), w, &f))
        return QDOT_NIL;
    return qdot_subs(pool, qdot_rational_write(t, &f, w), 1, &w, &r->generator[0].expr);
}

/* --- roots of (a x + b)/(c x + d) ---------------------------------------------------- */

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

qdot_expr
qdot_linear_root_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x, int depth)
{
    qdot_pool *pool = t->pool;
    int at = -1;
    qdot_poly over, under;
    qdot_expr w, wq, X, e, F, b, from[QDOT_READING_GENERATORS + 1], to[QDOT_READING_GENERATORS + 1];

    for (int i = 0; i < r->n; i++) {
        if (r->generator[i].kind != QDOT_GEN_ROOT)
            return QDOT_NIL;
        if ((at < 0 || r->generator[i].order > r->generator[at].order) &&
            read_linear_fraction(t, r->generator[i].of, x, &over, &under))
            at = i;
    }
    if (at < 0 || depth > 3 || !read_linear_fraction(t, r->generator[at].of, x, &over, &under))
        return QDOT_NIL;
    w = qdot_integral_variable(t, true);
    wq = qdot_pow_int(pool, w, r->generator[at].order);
    /* w^q = (a x + b)/(c x + d): x = (b - d w^q)/(c w^q - a) */
#define AT(p, i) ((p).degree >= (i) ? (p).c[i] : QDOT_ZERO)
    b = qdot_sub(pool, AT(over, 0), qdot_mul(pool, AT(under, 0), wq));
    X = qdot_div(pool, b, qdot_sub(pool, qdot_mul(pool, AT(under, 1), wq), AT(over, 1)));
#undef AT
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
