/* quadratic-root.c -- integrates rational functions of x and y = sqrt(q), q = a x^2 + b x + c.
 *
 *     R(x, y) = A(x) + G(x)/y,   G = P + sum a_i/f_i^k_i
 *
 * P/y and powers of f_i are reduced by derivatives of S(x) y, with S a polynomial over a power of f_i; what remains is
 *
 *     int 1/y,   int 1/((x - r) y),   int (p x + s)/(f y) with f, q even in x - h: over (x - h)/y and over y.
 *
 * (x - h)/y is increasing or decreasing wherever y is real: none of these has a jump where R has none.
 *
 * Source  Hardy, The Integration of Functions (1916), V; Gradshteyn & Ryzhik, 2.25
 * Tests   tests/normal/integral/test_antiderivative.c
 */
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

typedef struct {
    qdot_integral_task *t;
    qdot_pool *pool;
    qdot_expr x, y; /* y: the root itself */
    qdot_poly q, dq;
    qdot_expr F; /* what has been integrated */
} root;

/* S' q + S q'/2: the numerator of (S y)' over y. */
static qdot_poly
slope_times_root(const root *r, const qdot_poly *S)
{
    qdot_poly u = qdot_poly_diff(r->t, S), v;

    u = qdot_poly_mul(r->t, &u, &r->q);
    v = qdot_poly_mul(r->t, S, &r->dq);
    v = qdot_poly_scale(r->t, &v, QDOT_HALF);
    return qdot_poly_add(r->t, &u, &v);
}

/* --- 1/y ----------------------------------------------------------------------------- */

static qdot_expr
integral_of_inverse(const root *r)
{
    qdot_pool *pool = r->t->pool;
    qdot_expr a = r->q.c[2], b = r->q.c[1], c = r->q.c[0], slope = qdot_poly_expr(r->t, &r->dq, r->x), s, d, k;
    int sign = qdot_integral_sign(r->t, a), of_d;

    d = qdot_integral_normal(r->t, qdot_sub(pool, qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, a, c)),
                                            qdot_mul(pool, b, b)));
    if (sign == 0 || d == QDOT_NIL)
        return QDOT_NIL;
    if (sign < 0) { /* real somewhere only if d < 0 */
        s = qdot_integral_normal(r->t, qdot_sqrt(pool, qdot_neg(pool, a)));
        k = qdot_integral_normal(r->t, qdot_sqrt(pool, qdot_neg(pool, d)));
        k = qdot_integral_normal(r->t, qdot_div(pool, qdot_neg(pool, slope), k));
        return qdot_div(pool, qdot_fun1(pool, QDOT_ASIN, k), s);
    }
    s = qdot_integral_normal(r->t, qdot_sqrt(pool, a));
    of_d = qdot_expr_sign(pool, d);
    if ((of_d & QDOT_POS) == QDOT_POS || (qdot_expr_is_constant(pool, d) && qdot_integral_sign(r->t, d) > 0)) {
        k = qdot_integral_normal(r->t, qdot_div(pool, slope, qdot_integral_normal(r->t, qdot_sqrt(pool, d))));
        return qdot_div(pool, qdot_fun1(pool, QDOT_ASINH, k), s);
    }
    k = qdot_mul(pool, qdot_expr_int(pool, 2), qdot_mul(pool, s, r->y));
    k = qdot_add(pool, slope, k);
    if (b == QDOT_ZERO) /* x + sqrt(x^2 + c): the constant factor 2 sqrt(a) is dropped */
        k = qdot_integral_normal(r->t, qdot_div(pool, k, qdot_mul(pool, qdot_expr_int(pool, 2), s)));
    return qdot_div(pool, qdot_integral_log(r->t, k), s);
}

/* --- simple poles -------------------------------------------------------------------- */

/* The integral of 1/((x - p) y). */
static qdot_expr
integral_at_pole(const root *r, qdot_expr p)
{
    qdot_integral_task *t = r->t;
    qdot_pool *pool = r->pool;
    qdot_expr v = qdot_poly_at(t, &r->q, p), s, e, at = qdot_sub(pool, r->x, p), two = qdot_expr_int(pool, 2);
    int sign = qdot_integral_sign(t, v);

    if (sign == 0)
        return QDOT_NIL;
    s = qdot_integral_root(t, sign > 0 ? v : qdot_neg(pool, v));
    e = qdot_add(pool, qdot_mul(pool, two, v), qdot_mul(pool, qdot_poly_at(t, &r->dq, p), at));
    if (sign > 0) { /* divided by the constant 2 s */
        e = qdot_add(pool, qdot_div(pool, e, qdot_mul(pool, two, s)), r->y);
        e = qdot_div(pool, e, at);
        return qdot_neg(pool, qdot_div(pool, qdot_integral_log(t, qdot_integral_normal(t, e)), s));
    }
    e = qdot_integral_normal(t, qdot_div(pool, e, qdot_mul(pool, two, s)));
    return qdot_div(pool, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, e, r->y)), s);
}

/* The integral of (p z + s)/(f y), z = x - h, f = f2 z^2 + f0 and q = a z^2 + c without linear terms. */
static qdot_expr
integral_over_even(const root *r, const qdot_poly *n, const qdot_poly *f, qdot_expr h)
{
    qdot_integral_task *t = r->t;
    qdot_pool *pool = r->pool;
    qdot_expr w = qdot_integral_variable(t, false), ww = qdot_mul(pool, w, w), z = qdot_sub(pool, r->x, h), F = QDOT_ZERO, part;
    qdot_expr a = r->q.c[2], c = qdot_poly_at(t, &r->q, h), f2 = f->c[2], f0 = qdot_poly_at(t, f, h), p, s, e;

    p = qdot_poly_coefficient(n, 1);
    s = qdot_poly_at(t, n, h);
    if (!qdot_integral_zero(t, p)) { /* over w = y: z dz = w dw/a, z^2 = (w^2 - c)/a */
        e = qdot_add(pool, qdot_mul(pool, f2, qdot_sub(pool, ww, c)), qdot_mul(pool, f0, a));
        part = qdot_rational_over(t, qdot_div(pool, p, e), w, r->y);
        F = part == QDOT_NIL ? part : qdot_add(pool, F, part);
    }
    if (F != QDOT_NIL && !qdot_integral_zero(t, s)) { /* over w = z/y: z^2 = c w^2/(1 - a w^2), dz/y = dw/(1 - a w^2) */
        e = qdot_sub(pool, QDOT_ONE, qdot_mul(pool, a, ww));
        e = qdot_add(pool, qdot_mul(pool, f2, qdot_mul(pool, c, ww)), qdot_mul(pool, f0, e));
        part = qdot_rational_over(t, qdot_div(pool, s, e), w, qdot_div(pool, z, r->y));
        F = part == QDOT_NIL ? part : qdot_add(pool, F, part);
    }
    return F;
}

/* The integral of n/(f y), f irreducible over the parameters. */
static qdot_expr
integral_over_factor(const root *r, const qdot_poly *n, const qdot_poly *f)
{
    qdot_integral_task *t = r->t;
    qdot_pool *pool = r->pool;
    qdot_expr h, d, s, F = QDOT_ZERO, p, value, part, two_a;

    if (n->degree < 0)
        return QDOT_ZERO;
    if (f->degree == 1) {
        F = integral_at_pole(r, qdot_integral_normal(t, qdot_div(pool, qdot_neg(pool, f->c[0]), f->c[1])));
        return F == QDOT_NIL ? F : qdot_mul(pool, qdot_div(pool, n->c[0], f->c[1]), F);
    }
    if (f->degree != 2)
        return QDOT_NIL;
    two_a = qdot_mul(pool, qdot_expr_int(pool, 2), f->c[2]);
    h = qdot_integral_normal(t, qdot_div(pool, qdot_neg(pool, f->c[1]), two_a));
    if (qdot_integral_zero(t, qdot_poly_at(t, &r->dq, h)))
        return integral_over_even(r, n, f, h);
    d = qdot_sub(pool, qdot_mul(pool, f->c[1], f->c[1]),
                 qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, f->c[2], f->c[0])));
    if (qdot_integral_sign(t, d) <= 0)
        return QDOT_NIL;
    s = qdot_div(pool, qdot_integral_root(t, d), two_a);
    for (int i = 0; i < 2 && F != QDOT_NIL; i++) { /* the two real roots: n(p)/(f'(p) (x - p) y) */
        p = qdot_integral_normal(t, i == 0 ? qdot_add(pool, h, s) : qdot_sub(pool, h, s));
        value = qdot_add(pool, qdot_mul(pool, two_a, p), f->c[1]);
        value = qdot_integral_normal(t, qdot_div(pool, qdot_poly_at(t, n, p), value));
        part = integral_at_pole(r, p);
        F = part == QDOT_NIL ? part : qdot_add(pool, F, qdot_mul(pool, value, part));
    }
    return F;
}

/* --- reduction ----------------------------------------------------------------------- */

/* Integrate a/(f^k y) by way of a'/(f y); a polynomial over y that is left is added to *poly. */
static bool
reduce_power(root *r, qdot_poly a, const qdot_poly *f, int64_t k, qdot_poly *poly)
{
    qdot_integral_task *t = r->t;
    qdot_poly df = qdot_poly_diff(t, f), g, rest, m, T, u;
    qdot_expr base = qdot_poly_expr(t, f, r->x), part;
    bool divides;

    qdot_poly_divide(t, &r->q, f, &g, &rest);
    divides = rest.degree < 0; /* f is a factor of q = f g */
    if (!divides)
        g = r->q;
    m = qdot_poly_mul(t, &df, &g);
    for (; k > (divides ? 0 : 1) && a.degree >= 0 && qdot_integral_goes(t); k--) {
        /* (T y/f^j)', j = k or k - 1, has over f^k y the numerator T' q + T q'/2 - j T f' q/f ... = a modulo f */
        int64_t j = divides ? k : k - 1;
        qdot_expr by = divides ? qdot_expr_ratio(t->pool, 1 - 2 * j, 2) : qdot_expr_int(t->pool, -j);
        qdot_poly by_m = qdot_poly_scale(t, &m, by), over;

        T = qdot_poly_quotient_mod(t, &a, &by_m, f);
        if (T.degree == -2)
            return false;
        over = slope_times_root(r, &T);
        if (divides) { /* - k T f' g */
            u = qdot_poly_mul(t, &T, &m);
            u = qdot_poly_scale(t, &u, qdot_expr_int(t->pool, -j));
            over = qdot_poly_add(t, &over, &u);
            a = qdot_poly_sub(t, &a, &over);
            qdot_poly_divide(t, &a, f, &u, &rest);
        } else {
            u = qdot_poly_mul(t, &T, &by_m);
            a = qdot_poly_sub(t, &a, &u);
            qdot_poly_divide(t, &a, f, &u, &rest);
            u = qdot_poly_sub(t, &u, &over);
        }
        if (u.degree == -2 || rest.degree >= 0)
            return false;
        part = qdot_mul(t->pool, qdot_poly_expr(t, &T, r->x), qdot_mul(t->pool, r->y, qdot_pow_int(t->pool, base, -j)));
        r->F = qdot_add(t->pool, r->F, part);
        a = u;
    }
    if (k == 0) {
        *poly = qdot_poly_add(t, poly, &a);
        return poly->degree != -2;
    }
    qdot_poly_divide(t, &a, f, &u, &rest);
    *poly = qdot_poly_add(t, poly, &u);
    part = integral_over_factor(r, &rest, f);
    r->F = qdot_add(t->pool, r->F, part);
    return r->F != QDOT_NIL && poly->degree != -2;
}

/* P/y: P = S' q + S q'/2 + lambda, from the highest power down. */
static bool
integrate_polynomial(root *r, qdot_poly P)
{
    qdot_integral_task *t = r->t;
    qdot_pool *pool = t->pool;
    qdot_poly S = {.degree = -1}, step;
    qdot_expr part;

    while (P.degree >= 1 && qdot_integral_goes(t)) { /* the leading term of (c x^n y)' y is c a (n + 1) x^(n+1) */
        int n = P.degree - 1;
        qdot_expr by = qdot_mul(pool, qdot_expr_int(pool, n + 1), r->q.c[2]);
        qdot_poly c = qdot_poly_monomial(qdot_integral_normal(t, qdot_div(pool, P.c[P.degree], by)), n);

        step = slope_times_root(r, &c);
        P = qdot_poly_sub(t, &P, &step);
        S = qdot_poly_add(t, &S, &c);
    }
    if (P.degree == -2 || S.degree == -2)
        return false;
    r->F = qdot_add(pool, r->F, qdot_mul(pool, qdot_poly_expr(t, &S, r->x), r->y));
    if (P.degree == 0) {
        part = integral_of_inverse(r);
        r->F = qdot_add(pool, r->F, qdot_mul(pool, P.c[0], part));
    }
    return r->F != QDOT_NIL;
}

/* Add the integral of G/y to F, y = sqrt(a x^2 + b x + c), G a rational function of x; false: it is not found. */
static bool
integrate_over_root(root *r, qdot_expr G)
{
    qdot_integral_task *t = r->t;
    qdot_reading g;
    qdot_poly n, P, f[QDOT_READING_FACTORS], over[QDOT_READING_FACTORS];
    int64_t power[QDOT_READING_FACTORS];

    if (G == QDOT_ZERO)
        return true;
    if (!qdot_reading_make(t, G, r->x, &g) || g.n > 0)
        return false;
    n = qdot_poly_read(t, qdot_mul(t->pool, g.rest, g.numerator), r->x);
    for (int i = 0; i < g.factors; i++) {
        f[i] = qdot_poly_read(t, g.factor[i].base, r->x);
        power[i] = g.factor[i].power;
    }
    if (!qdot_rational_fractions(t, &n, g.factors, f, power, &P, over))
        return false;
    for (int i = 0; i < g.factors; i++)
        if (over[i].degree >= 0 && !reduce_power(r, over[i], &f[i], power[i], &P))
            return false;
    return integrate_polynomial(r, P);
}

/* The integrand (n0 + n1 y)/(d0 + d1 y) with y^2 = q. */
typedef struct {
    qdot_expr q, y, n0, n1, d0, d1;
} quotient;

/* Read an integrand that holds one square root. */
static bool
read_one_root(qdot_integral_task *t, const qdot_reading *g, quotient *e)
{
    const qdot_expr Y = g->generator[0].symbol;

    e->q = g->generator[0].of;
    e->y = g->generator[0].expr;
    return qdot_poly_read_root(t, qdot_mul(t->pool, g->rest, g->numerator), Y, e->q, &e->n0, &e->n1) &&
           qdot_poly_read_root(t, qdot_reading_denominator(t, g), Y, e->q, &e->d0, &e->d1);
}

/* e = lo + hi y, or e = (lo + hi y)/Y1 where it is *odd, y = Y1 Y2: it changes by its sign alone, if at all, where both roots do. */
static bool
read_product_of_roots(qdot_integral_task *t, const qdot_reading *g, qdot_expr e, bool *odd, qdot_expr *lo, qdot_expr *hi)
{
    const qdot_expr q1 = g->generator[0].of, Y1 = g->generator[0].symbol, q2 = g->generator[1].of, Y2 = g->generator[1].symbol;
    qdot_expr e0, e1, e00, e01, e10, e11; /* e_ij Y1^i Y2^j */

    if (!qdot_poly_read_root(t, e, Y1, q1, &e0, &e1) || !qdot_poly_read_root(t, e0, Y2, q2, &e00, &e01) ||
        !qdot_poly_read_root(t, e1, Y2, q2, &e10, &e11))
        return false;
    *odd = e00 == QDOT_ZERO && e11 == QDOT_ZERO;
    *lo = *odd ? qdot_mul(t->pool, q1, e10) : e00;
    *hi = *odd ? e01 : e11;
    return *odd || (e10 == QDOT_ZERO && e01 == QDOT_ZERO);
}

/* Read an integrand that holds the roots of two linear factors of q by their product only: sqrt(4 - x^2) is
 * sqrt(2 - x) sqrt(2 + x) where x > 0 is known. */
static bool
read_two_roots(qdot_integral_task *t, const qdot_reading *g, quotient *e)
{
    bool odd_over, odd_under;

    e->q = qdot_mul(t->pool, g->generator[0].of, g->generator[1].of);
    e->y = qdot_mul(t->pool, g->generator[0].expr, g->generator[1].expr);
    return read_product_of_roots(t, g, qdot_mul(t->pool, g->rest, g->numerator), &odd_over, &e->n0, &e->n1) &&
           read_product_of_roots(t, g, qdot_reading_denominator(t, g), &odd_under, &e->d0, &e->d1) && odd_over == odd_under;
}

qdot_expr
qdot_quadratic_root_integrate(qdot_integral_task *t, const qdot_reading *g, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    root r = {.t = t, .pool = pool, .x = x, .F = QDOT_ZERO};
    qdot_expr under, A, G;
    quotient e;

    for (int i = 0; i < g->n; i++)
        if (g->generator[i].kind != QDOT_GEN_ROOT || g->generator[i].order != 2)
            return QDOT_NIL;
    if ((g->n != 1 || !read_one_root(t, g, &e)) && (g->n != 2 || !read_two_roots(t, g, &e)))
        return QDOT_NIL;
    r.q = qdot_poly_read(t, e.q, x);
    if (r.q.degree != 2)
        return QDOT_NIL;
    r.y = e.y;
    r.dq = qdot_poly_diff(t, &r.q);
    under = qdot_sub(pool, qdot_mul(pool, e.d0, e.d0), qdot_mul(pool, e.q, qdot_mul(pool, e.d1, e.d1)));
    A = qdot_sub(pool, qdot_mul(pool, e.n0, e.d0), qdot_mul(pool, e.q, qdot_mul(pool, e.n1, e.d1)));
    A = qdot_integral_normal(t, qdot_div(pool, A, under));
    G = qdot_sub(pool, qdot_mul(pool, e.n1, e.d0), qdot_mul(pool, e.n0, e.d1));
    G = qdot_integral_normal(t, qdot_div(pool, qdot_mul(pool, e.q, G), under));
    if (A == QDOT_NIL || G == QDOT_NIL)
        return QDOT_NIL;
    if (A != QDOT_ZERO)
        r.F = qdot_rational_over(t, A, x, x);
    return r.F != QDOT_NIL && integrate_over_root(&r, G) ? r.F : QDOT_NIL;
}
