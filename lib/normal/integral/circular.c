/* circular.c -- integrates rational functions of the sine and cosine of one angle, circular or hyperbolic. */
#include "normal/integral/circular.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"

typedef struct {
    qdot_integral_task *t;
    qdot_pool *pool;
    bool hyperbolic;
    qdot_expr S, C;       /* symbols that stand for the sine and the cosine */
    qdot_expr u, slope;   /* the angle and du/dx */
    qdot_expr numerator, denominator; /* of the integrand, over du */
} circular;

static qdot_expr
sine(const circular *c, qdot_expr u)
{
    return qdot_fun1(c->pool, c->hyperbolic ? QDOT_SINH : QDOT_SIN, u);
}

static qdot_expr
cosine(const circular *c, qdot_expr u)
{
    return qdot_fun1(c->pool, c->hyperbolic ? QDOT_COSH : QDOT_COS, u);
}

/* --- writing primitives in T = tan v --------------------------------------------------- */

/* p(T) cos^n v, n the degree of p; of degree 2 in 2v, up to a constant factor. */
static qdot_expr
homogeneous(const circular *c, const qdot_poly *p, qdot_expr v)
{
    qdot_pool *pool = c->pool;
    qdot_expr s = sine(c, v), co = cosine(c, v), sum = QDOT_ZERO, two_v = qdot_mul(pool, qdot_expr_int(pool, 2), v);

    if (p->degree == 2) { /* a s^2 + b s co + d co^2 */
        qdot_expr low = c->hyperbolic ? qdot_sub(pool, p->c[0], p->c[2]) : qdot_add(pool, p->c[0], p->c[2]);
        qdot_expr high = c->hyperbolic ? qdot_add(pool, p->c[0], p->c[2]) : qdot_sub(pool, p->c[0], p->c[2]);

        sum = qdot_add(pool, low, qdot_mul(pool, high, cosine(c, two_v)));
        return qdot_integral_normal(c->t, qdot_add(pool, sum, qdot_mul(pool, p->c[1], sine(c, two_v))));
    }
    for (int i = 0; i <= p->degree; i++)
        sum = qdot_add(pool, sum, qdot_mul(pool, p->c[i], qdot_mul(pool, qdot_pow_int(pool, s, i),
                                                                   qdot_pow_int(pool, co, p->degree - i))));
    return sum;
}

/* atan(a T + b), T = tan v, without jumps. */
static qdot_expr
arc_without_jumps(const circular *c, const qdot_poly *p, qdot_expr v)
{
    qdot_pool *pool = c->pool;
    qdot_expr a = p->c[1], b = p->c[0], k, two = qdot_expr_int(pool, 2), ab, over, under, e;
    qdot_expr s = sine(c, qdot_mul(pool, two, v)), co = cosine(c, qdot_mul(pool, two, v));
    int sign = qdot_integral_sign(c->t, a);

    if (sign == 0)
        return QDOT_NIL;
    if (sign < 0) {
        qdot_poly opposite = qdot_poly_scale(c->t, p, QDOT_MINUS_ONE);

        return qdot_neg(pool, arc_without_jumps(c, &opposite, v));
    }
    if (qdot_integral_zero(c->t, b)) {
        k = qdot_sub(pool, QDOT_ONE, a);
        over = qdot_neg(pool, qdot_mul(pool, k, s));
        under = qdot_add(pool, qdot_add(pool, QDOT_ONE, a), qdot_mul(pool, k, co));
    } else {
        k = qdot_add(pool, qdot_sub(pool, QDOT_ONE, qdot_mul(pool, a, a)), qdot_mul(pool, b, b));
        ab = qdot_mul(pool, two, qdot_mul(pool, a, b));
        over = qdot_sub(pool, qdot_mul(pool, ab, co), qdot_mul(pool, k, s));
        e = qdot_add(pool, QDOT_ONE, a);
        under = qdot_add(pool, qdot_add(pool, qdot_mul(pool, e, e), qdot_mul(pool, b, b)),
                         qdot_add(pool, qdot_mul(pool, k, co), qdot_mul(pool, ab, s)));
    }
    e = qdot_integral_normal(c->t, qdot_div(pool, over, under));
    /* or divided by 1 - a: -sin 2v/((1 + a)^2/(1 - a^2) + cos 2v), which has fewer roots where a is one */
    ab = qdot_integral_normal(c->t, qdot_mul(pool, a, a));
    k = qdot_integral_normal(c->t, qdot_sub(pool, QDOT_ONE, ab));
    if (qdot_integral_zero(c->t, b) && !qdot_integral_zero(c->t, k) &&
        (qdot_expr_is_constant(pool, a) || qdot_expr_size(pool, ab) < qdot_expr_size(pool, a))) {
        under = qdot_add(pool, QDOT_ONE, qdot_mul(pool, a, qdot_add(pool, a, two)));
        under = qdot_integral_normal(c->t, qdot_div(pool, under, k));
        under = qdot_add(pool, under, co);
        over = qdot_neg(pool, qdot_div(pool, s, under));
        if (qdot_expr_size(pool, over) < qdot_expr_size(pool, e))
            e = over;
    }
    return qdot_add(pool, v, qdot_fun1(pool, QDOT_ATAN, e));
}

/* Whether p is a (T + sign). */
static bool
is_unit_factor(const circular *c, const qdot_poly *p, int sign)
{
    return p->degree == 1 &&
           qdot_integral_zero(c->t, sign > 0 ? qdot_sub(c->pool, p->c[0], p->c[1]) : qdot_add(c->pool, p->c[0], p->c[1]));
}

/* The primitive f in T = tan v (or tanh v) as an expression that does not jump; nil: not possible. */
static qdot_expr
write_without_jumps(const circular *c, const qdot_primitive *f, qdot_expr T, qdot_expr v)
{
    qdot_integral_task *t = c->t;
    qdot_pool *pool = c->pool;
    const bool hyperbolic = c->hyperbolic;
    qdot_expr two_v = qdot_mul(pool, qdot_expr_int(pool, 2), v), sum, left = QDOT_ZERO, part;
    qdot_expr coefficient[QDOT_PRIMITIVE_TERMS + 1], inside[QDOT_PRIMITIVE_TERMS + 1];
    int logs = 0;

    if (f->rest != QDOT_ZERO && qdot_poly_read(t, f->rest, T).degree >= 0)
        sum = qdot_subs(pool, f->rest, 1, &T, &(qdot_expr){qdot_fun1(pool, hyperbolic ? QDOT_TANH : QDOT_TAN, v)});
    else
        sum = qdot_subs(pool, f->rest, 1, &T, &(qdot_expr){qdot_div(pool, sine(c, two_v), qdot_add(pool, QDOT_ONE, cosine(c, two_v)))});
    sum = qdot_integral_normal(t, sum);
    for (int i = 0; i < f->n; i++) {
        const qdot_poly *p = &f->term[i].p;
        qdot_expr k = f->term[i].c;

        if (f->term[i].angle) {
            if (p->degree != 1)
                return QDOT_NIL;
            part = hyperbolic ? qdot_fun1(pool, QDOT_ATAN, qdot_subs(pool, qdot_poly_expr(t, p, T), 1, &T,
                                                                     &(qdot_expr){qdot_fun1(pool, QDOT_TANH, v)}))
                              : arc_without_jumps(c, p, v);
            sum = qdot_add(pool, sum, qdot_mul(pool, k, part));
            continue;
        }
        left = qdot_sub(pool, left, qdot_mul(pool, k, qdot_expr_int(pool, p->degree)));
        if (hyperbolic && is_unit_factor(c, p, 1)) {
            sum = qdot_add(pool, sum, qdot_mul(pool, k, v));
        } else if (hyperbolic && is_unit_factor(c, p, -1)) {
            sum = qdot_sub(pool, sum, qdot_mul(pool, k, v));
        } else {
            coefficient[logs] = k;
            inside[logs] = homogeneous(c, p, v);
            if (!qdot_expr_contains(pool, inside[logs], v) && qdot_expr_node(pool, v)->height == 0)
                continue; /* 1 + T^2: a constant */
            logs++;
        }
    }
    left = qdot_integral_normal(t, left);
    for (int i = 0; i < logs; i++)
        if (inside[i] == sine(c, v) && qdot_integral_normal(t, qdot_add(pool, coefficient[i], left)) == QDOT_ZERO) {
            inside[i] = qdot_fun1(pool, hyperbolic ? QDOT_TANH : QDOT_TAN, v);
            left = QDOT_ZERO;
        }
    coefficient[logs] = left;
    inside[logs++] = cosine(c, v);
    return qdot_add(pool, sum, qdot_rational_logs(t, logs, coefficient, inside));
}

/* --- the substitutions ------------------------------------------------------------------ */

/* Reduce e, a polynomial in S and C, to lo + hi V with V = S (by_sine) or C, lo and hi polynomials in the other one. */
static bool
reduce_to_linear(const circular *c, qdot_expr e, bool by_sine, qdot_expr *lo, qdot_expr *hi)
{
    qdot_pool *pool = c->pool;
    qdot_expr V = by_sine ? c->S : c->C, W = by_sine ? c->C : c->S, square;

    square = qdot_mul(pool, W, W); /* circular: V^2 = 1 - W^2; S^2 = C^2 - 1, C^2 = 1 + S^2 */
    square = !c->hyperbolic ? qdot_sub(pool, QDOT_ONE, square)
             : by_sine      ? qdot_sub(pool, square, QDOT_ONE)
                            : qdot_add(pool, square, QDOT_ONE);
    if (!qdot_poly_read_root(c->t, e, V, square, lo, hi))
        return false;
    *lo = qdot_integral_normal(c->t, *lo);
    *hi = qdot_integral_normal(c->t, *hi);
    return *lo != QDOT_NIL && *hi != QDOT_NIL;
}

/* The parity of a polynomial in x: 1 even, -1 odd, 0 neither. Zero is even. */
static int
parity(const circular *c, qdot_expr e, qdot_expr x)
{
    qdot_poly p = qdot_poly_read(c->t, e, x);
    bool even = false, odd = false;

    for (int i = 0; i <= p.degree; i++)
        if (p.c[i] != QDOT_ZERO)
            *(i % 2 == 0 ? &even : &odd) = true;
    return p.degree == -2 || (even && odd) ? 0 : odd ? -1 : 1;
}

/* Replace V^(2k) by square^k in e; nil if V occurs with an odd power. */
static qdot_expr
replace_squares(const circular *c, qdot_expr e, qdot_expr V, qdot_expr square)
{
    qdot_poly p = qdot_poly_read(c->t, e, V);
    qdot_expr sum = QDOT_ZERO;

    for (int i = 0; i <= p.degree; i++) {
        if (i % 2 == 1 && p.c[i] != QDOT_ZERO)
            return QDOT_NIL;
        sum = qdot_add(c->pool, sum, qdot_mul(c->pool, p.c[i], qdot_pow_int(c->pool, square, i / 2)));
    }
    return p.degree == -2 ? QDOT_NIL : sum;
}

/* 1 + T^2, or 1 - T^2 for hyperbolic functions: 1/cos^2 v. */
static qdot_expr
inverse_square(const circular *c, qdot_expr T)
{
    qdot_expr square = qdot_mul(c->pool, T, T);

    return c->hyperbolic ? qdot_sub(c->pool, QDOT_ONE, square) : qdot_add(c->pool, QDOT_ONE, square);
}

/* Over T = tan u: numerator and denominator n/d of one parity under (S, C) -> (-S, -C). */
static qdot_expr
integrate_over_tangent(const circular *c, qdot_expr n, qdot_expr d)
{
    qdot_pool *pool = c->pool;
    qdot_expr T = qdot_integral_variable(c->t, false), S = qdot_mul(pool, T, c->C), w = inverse_square(c, T);
    qdot_expr e;
    qdot_primitive f;

    n = qdot_subs(pool, n, 1, &c->S, &S);
    d = qdot_subs(pool, d, 1, &c->S, &S);
    if (parity(c, d, c->C) == -1) {
        n = qdot_mul(pool, n, c->C);
        d = qdot_mul(pool, d, c->C);
    }
    n = replace_squares(c, n, c->C, qdot_div(pool, QDOT_ONE, w));
    d = replace_squares(c, d, c->C, qdot_div(pool, QDOT_ONE, w));
    if (n == QDOT_NIL || d == QDOT_NIL)
        return QDOT_NIL;
    e = qdot_div(pool, n, qdot_mul(pool, d, w));
    return qdot_rational_integrate(c->t, e, T, &f) ? write_without_jumps(c, &f, T, c->u) : QDOT_NIL;
}

/* Over T = tan(u/2). */
static qdot_expr
integrate_over_half_tangent(const circular *c, qdot_expr n, qdot_expr d)
{
    qdot_pool *pool = c->pool;
    qdot_expr T = qdot_integral_variable(c->t, false), w = inverse_square(c, T), two = qdot_expr_int(pool, 2), e;
    qdot_expr square = qdot_mul(pool, T, T), from[] = {c->S, c->C}, to[2];
    qdot_primitive f;

    to[0] = qdot_div(pool, qdot_mul(pool, two, T), w);
    to[1] = qdot_div(pool, c->hyperbolic ? qdot_add(pool, QDOT_ONE, square) : qdot_sub(pool, QDOT_ONE, square), w);
    e = qdot_div(pool, qdot_mul(pool, two, qdot_div(pool, n, d)), w);
    e = qdot_subs(pool, e, 2, from, to);
    return qdot_rational_integrate(c->t, e, T, &f)
               ? write_without_jumps(c, &f, T, qdot_mul(pool, QDOT_HALF, c->u))
               : QDOT_NIL;
}

/* n(C)/d(C), without the sine. */
static qdot_expr
integrate_cosines(const circular *c, qdot_expr n, qdot_expr d)
{
    qdot_pool *pool = c->pool;
    int of_n = parity(c, n, c->C), of_d = parity(c, d, c->C);
    qdot_expr V, square, even, odd, e;
    qdot_poly p, q;

    if (n == QDOT_ZERO)
        return QDOT_ZERO;
    if (of_n != 0 && of_d != 0) {
        if (of_n == of_d)
            return integrate_over_tangent(c, n, d);
        V = qdot_integral_variable(c->t, false); /* over the sine */
        square = qdot_mul(pool, V, V);
        square = c->hyperbolic ? qdot_add(pool, square, QDOT_ONE) : qdot_sub(pool, QDOT_ONE, square);
        n = of_n == -1 ? qdot_expand(pool, qdot_div(pool, n, c->C)) : n;
        d = of_n == -1 ? d : qdot_expand(pool, qdot_mul(pool, d, c->C));
        n = replace_squares(c, n, c->C, square);
        d = replace_squares(c, d, c->C, square);
        return n == QDOT_NIL || d == QDOT_NIL ? QDOT_NIL
                                              : qdot_rational_over(c->t, qdot_div(pool, n, d), V, sine(c, c->u));
    }
    q = qdot_poly_read(c->t, d, c->C);
    for (int i = 0; i < q.degree; i++)
        if (q.c[i] != QDOT_ZERO)
            return integrate_over_half_tangent(c, n, d);
    p = qdot_poly_read(c->t, n, c->C); /* d is a power of C: no pole is added by taking n apart */
    if (p.degree == -2 || q.degree == -2)
        return QDOT_NIL;
    even = odd = QDOT_ZERO;
    for (int i = 0; i <= p.degree; i++) {
        e = qdot_mul(pool, p.c[i], qdot_pow_int(pool, c->C, i));
        *(i % 2 == 0 ? &even : &odd) = qdot_add(pool, i % 2 == 0 ? even : odd, e);
    }
    even = integrate_cosines(c, even, d);
    odd = integrate_cosines(c, odd, d);
    return qdot_add(pool, even, odd);
}

static qdot_expr
integrate_over_angle(const circular *c)
{
    qdot_pool *pool = c->pool;
    qdot_expr n0, n1, d0, d1, m0, m1, e0, e1, F, G, V;
    int k;

    if (!reduce_to_linear(c, c->numerator, true, &n0, &n1) || !reduce_to_linear(c, c->denominator, true, &d0, &d1))
        return QDOT_NIL;
    if (d1 == QDOT_ZERO) {
        F = QDOT_ZERO;
        if (n1 != QDOT_ZERO && n0 != QDOT_ZERO && parity(c, d0, c->C) == 0) /* one substitution for the whole */
            return integrate_over_half_tangent(c, c->numerator, d0);
        if (n1 != QDOT_ZERO) {
            V = qdot_integral_variable(c->t, false);
            F = qdot_rational_over(c->t, qdot_subs(pool, qdot_div(pool, n1, d0), 1, &c->C, &V), V, cosine(c, c->u));
            F = c->hyperbolic || F == QDOT_NIL ? F : qdot_neg(pool, F);
        }
        G = integrate_cosines(c, n0, d0);
        return F == QDOT_NIL || G == QDOT_NIL ? QDOT_NIL : qdot_add(pool, F, G);
    }
    if (reduce_to_linear(c, c->numerator, false, &m0, &m1) && reduce_to_linear(c, c->denominator, false, &e0, &e1) &&
        e1 == QDOT_ZERO && m0 == QDOT_ZERO) { /* odd in the cosine */
        V = qdot_integral_variable(c->t, false);
        return qdot_rational_over(c->t, qdot_subs(pool, qdot_div(pool, m1, e0), 1, &c->S, &V), V, sine(c, c->u));
    }
    k = parity(c, d0, c->C);
    if (k != 0 && parity(c, d1, c->C) == -k &&
        (n0 == QDOT_ZERO || parity(c, n0, c->C) == k) && (n1 == QDOT_ZERO || parity(c, n1, c->C) == -k))
        return integrate_over_tangent(c, qdot_add(pool, n0, qdot_mul(pool, n1, c->S)),
                                      qdot_add(pool, d0, qdot_mul(pool, d1, c->S)));
    return integrate_over_half_tangent(c, c->numerator, c->denominator);
}

qdot_expr
qdot_circular_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x)
{
    circular c = {.t = t, .pool = t->pool};
    qdot_expr F;

    if (r->bare || r->n < 1 || r->n > 2)
        return QDOT_NIL;
    c.u = r->generator[0].of;
    for (int i = 0; i < r->n; i++) {
        qdot_gen_kind kind = r->generator[i].kind;

        if (kind < QDOT_GEN_SIN || kind > QDOT_GEN_COSH || r->generator[i].of != c.u ||
            (i > 0 && c.hyperbolic != (kind == QDOT_GEN_SINH || kind == QDOT_GEN_COSH)))
            return QDOT_NIL;
        c.hyperbolic = kind == QDOT_GEN_SINH || kind == QDOT_GEN_COSH;
        *(kind == QDOT_GEN_SIN || kind == QDOT_GEN_SINH ? &c.S : &c.C) = r->generator[i].symbol;
    }
    if (c.S == QDOT_NIL)
        c.S = qdot_integral_variable(t, false);
    if (c.C == QDOT_NIL)
        c.C = qdot_integral_variable(t, false);
    c.slope = qdot_integral_slope(t->pool, c.u, x);
    if (c.slope == QDOT_NIL)
        return QDOT_NIL;
    c.numerator = qdot_mul(t->pool, r->rest, r->numerator);
    c.denominator = qdot_reading_denominator(t, r);
    F = integrate_over_angle(&c);
    return F == QDOT_NIL ? F : qdot_div(t->pool, F, c.slope);
}
