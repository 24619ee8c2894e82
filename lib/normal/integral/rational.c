/* rational.c -- integrates rational functions: partial fractions, Hermite's reduction, logarithms and arcs. */
#include "normal/integral/rational.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/integral/reading.h"

static bool integrate_over_factor(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out);

bool
qdot_primitive_add(qdot_integral_task *t, qdot_primitive *out, bool angle, qdot_expr c, qdot_poly p)
{
    c = qdot_integral_normal(t, c);
    if (c == QDOT_NIL || p.degree == -2)
        return false;
    if (qdot_integral_zero(t, c))
        return true;
    if (out->n == QDOT_PRIMITIVE_TERMS)
        return false;
    out->term[out->n].angle = angle;
    out->term[out->n].c = c;
    out->term[out->n++].p = p;
    return true;
}

/* Integrate n/f with f = a x^2 + b x + c: it is the derivative of log f, and a rest r/f that is an atan or two logarithms. */
static bool
integrate_over_quadratic(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    qdot_pool *pool = t->pool;
    qdot_expr a = f->c[2], b = f->c[1], c = f->c[0], two_a = qdot_mul(pool, qdot_expr_int(pool, 2), a);
    qdot_expr top = qdot_poly_coefficient(n, 1), low = qdot_poly_coefficient(n, 0);
    qdot_expr k = qdot_div(pool, top, two_a), r, d, s;
    int sign;

    r = qdot_integral_normal(t, qdot_sub(pool, low, qdot_mul(pool, k, b)));
    if (!qdot_primitive_add(t, out, false, k, *f))
        return false;
    if (r == QDOT_NIL || qdot_integral_zero(t, r))
        return r != QDOT_NIL;
    d = qdot_integral_normal(t, qdot_sub(pool, qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, a, c)),
                                         qdot_mul(pool, b, b)));
    sign = qdot_integral_sign(t, d);
    s = sign == 0 ? QDOT_NIL : qdot_integral_root(t, sign > 0 ? d : qdot_neg(pool, d));
    if (s == QDOT_NIL)
        return false;
    if (sign > 0)
        return qdot_primitive_add(t, out, true, qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), r), s),
                        qdot_poly_linear(t, qdot_div(pool, two_a, s), qdot_div(pool, b, s)));
    k = qdot_div(pool, r, s);
    return qdot_primitive_add(t, out, false, k, qdot_poly_linear(t, two_a, qdot_sub(pool, b, s))) &&
           qdot_primitive_add(t, out, false, qdot_neg(pool, k), qdot_poly_linear(t, two_a, qdot_add(pool, b, s)));
}

/* Integrate n over the product f of two factors g and h without a common root. */
static bool
integrate_over_two(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *g, const qdot_poly *h, qdot_primitive *out)
{
    qdot_poly u = qdot_poly_quotient_mod(t, n, h, g), v = qdot_poly_quotient_mod(t, n, g, h);

    return u.degree != -2 && v.degree != -2 && integrate_over_factor(t, &u, g, out) &&
           integrate_over_factor(t, &v, h, out);
}

/* p(x + s) */
static qdot_poly
shift_variable(qdot_integral_task *t, const qdot_poly *p, qdot_expr s)
{
    qdot_poly r = {.degree = -1}, x = qdot_poly_linear(t, QDOT_ONE, s);

    for (int i = p->degree; i >= 0; i--) {
        qdot_poly c = qdot_poly_constant(t, p->c[i]);

        r = qdot_poly_mul(t, &r, &x);
        r = qdot_poly_add(t, &r, &c);
    }
    return r;
}

/* Real factors g, h of f = x^4 + p x^2 + q. */
static bool
split_biquadratic(qdot_integral_task *t, const qdot_poly *f, qdot_poly *g, qdot_poly *h)
{
    qdot_pool *pool = t->pool;
    qdot_expr p = f->c[2], q = f->c[0], d, s, alpha;
    int sign;

    d = qdot_sub(pool, qdot_mul(pool, p, p), qdot_mul(pool, qdot_expr_int(pool, 4), q));
    sign = qdot_integral_sign(t, d);
    *g = *h = (qdot_poly){.degree = 2, .c = {QDOT_ZERO, QDOT_ZERO, QDOT_ONE}};
    if (sign > 0) {
        s = qdot_integral_root(t, d);
        g->c[0] = qdot_integral_normal(t, qdot_mul(pool, QDOT_HALF, qdot_add(pool, p, s)));
        h->c[0] = qdot_integral_normal(t, qdot_mul(pool, QDOT_HALF, qdot_sub(pool, p, s)));
    } else if (sign < 0) {
        s = qdot_integral_normal(t, qdot_sqrt(pool, q)); /* q > p^2/4 */
        alpha = qdot_integral_root(t, qdot_sub(pool, qdot_mul(pool, qdot_expr_int(pool, 2), s), p));
        g->c[0] = h->c[0] = s;
        g->c[1] = alpha;
        h->c[1] = qdot_neg(pool, alpha);
    }
    return sign != 0 && g->c[0] != QDOT_NIL && g->c[1] != QDOT_NIL && h->c[0] != QDOT_NIL;
}

/* Real factors of f = x^4 + a x^3 + b x^2 + a k x + k^2, which is x^2 (y^2 + a y + b - 2 k) in y = x + k/x: two x^2 - y x + k.
 * False: f is another polynomial, or its roots y are not real. */
static bool
split_reciprocal(qdot_integral_task *t, const qdot_poly *f, qdot_poly *g, qdot_poly *h)
{
    qdot_pool *pool = t->pool;
    const qdot_expr a = f->c[3], two = qdot_expr_int(pool, 2);
    qdot_expr k, d, s;

    if (qdot_integral_zero(t, a))
        return false;
    k = qdot_integral_normal(t, qdot_div(pool, f->c[1], a));
    if (k == QDOT_NIL || !qdot_integral_zero(t, qdot_sub(pool, qdot_mul(pool, k, k), f->c[0])))
        return false;
    d = qdot_sub(pool, qdot_mul(pool, a, a),
                 qdot_mul(pool, qdot_expr_int(pool, 4), qdot_sub(pool, f->c[2], qdot_mul(pool, two, k))));
    if (qdot_integral_sign(t, d) != 1)
        return false;
    s = qdot_integral_root(t, d);
    *g = *h = (qdot_poly){.degree = 2, .c = {k, QDOT_ZERO, QDOT_ONE}};
    g->c[1] = qdot_integral_normal(t, qdot_mul(pool, QDOT_HALF, qdot_add(pool, a, s)));
    h->c[1] = qdot_integral_normal(t, qdot_mul(pool, QDOT_HALF, qdot_sub(pool, a, s)));
    return g->c[1] != QDOT_NIL && h->c[1] != QDOT_NIL;
}

/* Real factors of f = x^3 + c. */
static bool
split_cubic(qdot_integral_task *t, const qdot_poly *f, qdot_poly *g, qdot_poly *h)
{
    qdot_pool *pool = t->pool;
    int sign = qdot_integral_sign(t, f->c[0]);
    qdot_expr r, c = sign < 0 ? qdot_neg(pool, f->c[0]) : f->c[0];

    r = qdot_integral_normal(t, qdot_pow(pool, c, qdot_expr_ratio(pool, 1, 3)));
    r = sign < 0 ? qdot_neg(pool, r) : r; /* r^3 = c of f */
    *g = (qdot_poly){.degree = 1, .c = {r, QDOT_ONE}};
    *h = (qdot_poly){.degree = 2, .c = {qdot_mul(pool, r, r), qdot_neg(pool, r), QDOT_ONE}};
    return sign != 0 && r != QDOT_NIL;
}

/* Split f, irreducible and of degree 3 or 4, over roots of parameters if it is of a kind that can be, and integrate n/f. */
static bool
integrate_over_split(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    qdot_pool *pool = t->pool;
    qdot_expr lead = f->c[f->degree], s;
    qdot_poly monic = qdot_poly_scale(t, f, qdot_div(pool, QDOT_ONE, lead)), g, h, top;
    bool split = false;

    if (monic.degree == -2)
        return false;
    if (monic.degree == 4 && split_reciprocal(t, &monic, &g, &h)) {
        top = qdot_poly_scale(t, n, qdot_div(pool, QDOT_ONE, lead));
        return integrate_over_two(t, &top, &g, &h, out);
    }
    s = qdot_integral_normal(t, qdot_div(pool, monic.c[monic.degree - 1], qdot_expr_int(pool, -monic.degree)));
    monic = shift_variable(t, &monic, s);
    if (monic.degree == 4 && qdot_integral_zero(t, monic.c[1]))
        split = split_biquadratic(t, &monic, &g, &h);
    else if (monic.degree == 3 && qdot_integral_zero(t, monic.c[1]))
        split = split_cubic(t, &monic, &g, &h);
    if (!split)
        return qdot_residues_integrate(t, n, f, out);
    s = qdot_neg(pool, s);
    g = shift_variable(t, &g, s);
    h = shift_variable(t, &h, s);
    top = qdot_poly_scale(t, n, qdot_div(pool, QDOT_ONE, lead));
    return integrate_over_two(t, &top, &g, &h, out);
}

/* Integrate n/f for an irreducible f of a degree beyond 4. */
static bool
integrate_over_high(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    const int before = out->n;

    if (qdot_residues_integrate(t, n, f, out))
        return true;
    out->n = before;
    return qdot_cyclotomic_integrate(t, n, f, out);
}

/* Integrate n/f, the degree of n below that of f, which has no multiple roots. */
static bool
integrate_over_factor(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    if (!qdot_integral_goes(t) || n->degree == -2)
        return false;
    if (n->degree < 0)
        return true;
    if (f->degree == 1)
        return qdot_primitive_add(t, out, false, qdot_div(t->pool, n->c[0], f->c[1]), *f);
    if (f->degree == 2)
        return integrate_over_quadratic(t, n, f, out);
    return f->degree > 4 ? integrate_over_high(t, n, f, out) : integrate_over_split(t, n, f, out);
}

/* Integrate a/f^k: Hermite's reduction down to k = 1. */
static bool
integrate_over_power(qdot_integral_task *t, qdot_poly a, const qdot_poly *f, int64_t k, qdot_expr x, qdot_primitive *out)
{
    qdot_pool *pool = t->pool;
    qdot_poly df = qdot_poly_diff(t, f), u, v, w, rest;
    qdot_expr base = qdot_poly_expr(t, f, x);

    for (; k > 1 && a.degree >= 0 && qdot_integral_goes(t); k--) {
        /* a = u f + v f': int a/f^k = -v/((k-1) f^(k-1)) + int (u + v'/(k-1))/f^(k-1) */
        qdot_expr over = qdot_expr_ratio(pool, 1, k - 1);

        v = qdot_poly_quotient_mod(t, &a, &df, f);
        w = qdot_poly_mul(t, &v, &df);
        w = qdot_poly_sub(t, &a, &w);
        qdot_poly_divide(t, &w, f, &u, &rest);
        w = qdot_poly_diff(t, &v);
        w = qdot_poly_scale(t, &w, over);
        a = qdot_poly_add(t, &u, &w);
        v = qdot_poly_scale(t, &v, qdot_neg(pool, over));
        if (a.degree == -2 || v.degree == -2)
            return false;
        out->rest = qdot_add(pool, out->rest, qdot_mul(pool, qdot_poly_expr(t, &v, x), qdot_pow_int(pool, base, 1 - k)));
    }
    /* for degrees that are not below that of f */
    qdot_poly_divide(t, &a, f, &u, &rest);
    u = qdot_poly_integral(t, &u);
    if (u.degree == -2)
        return false;
    out->rest = qdot_add(pool, out->rest, qdot_poly_expr(t, &u, x));
    return integrate_over_factor(t, &rest, f, out);
}

/* The largest k such that n and the denominator are x^(k-1) N(x^k) and D(x^k); n = x^(k-1) N needs k > 1. */
static int
common_step(const qdot_poly *n, int factors, const qdot_poly *f)
{
    for (int k = QDOT_POLY_MOST; k > 1; k--) {
        bool fits = true;

        for (int i = 0; i <= n->degree && fits; i++)
            fits = n->c[i] == QDOT_ZERO || i % k == k - 1;
        for (int j = 0; j < factors && fits; j++)
            for (int i = 0; i <= f[j].degree && fits; i++)
                fits = f[j].c[i] == QDOT_ZERO || i % k == 0;
        if (fits)
            return k;
    }
    return 1;
}

/* Replace x^k by x in p = x^shift P(x^k). */
static qdot_poly
lower_step(const qdot_poly *p, int k, int shift)
{
    qdot_poly r = {.degree = p->degree < 0 ? p->degree : (p->degree - shift) / k};

    for (int i = 0; i <= r.degree; i++)
        r.c[i] = p->c[i * k + shift];
    return r;
}

static qdot_poly
raise_step(const qdot_poly *p, int k)
{
    qdot_poly r = {.degree = p->degree * k};

    if (p->degree < 0 || r.degree > QDOT_POLY_MOST)
        return (qdot_poly){.degree = -2};
    for (int i = 0; i <= r.degree; i++)
        r.c[i] = i % k == 0 ? p->c[i / k] : QDOT_ZERO;
    return r;
}

bool
qdot_rational_fractions(qdot_integral_task *t, const qdot_poly *n, int count, const qdot_poly *f, const int64_t *power,
                        qdot_poly *whole, qdot_poly *over)
{
    qdot_poly all = qdot_poly_constant(t, QDOT_ONE), rest, part[QDOT_READING_FACTORS];

    for (int i = 0; i < count; i++) {
        part[i] = qdot_poly_power(t, &f[i], power[i]);
        all = qdot_poly_mul(t, &all, &part[i]);
    }
    qdot_poly_divide(t, n, &all, whole, &rest);
    if (whole->degree == -2 || rest.degree == -2)
        return false;
    for (int i = 0; i < count; i++) {
        qdot_poly others = qdot_poly_constant(t, QDOT_ONE);

        over[i] = rest;
        if (rest.degree < 0)
            continue;
        for (int j = 0; j < count; j++)
            if (j != i)
                others = qdot_poly_mul(t, &others, &part[j]);
        over[i] = qdot_poly_quotient_mod(t, &rest, &others, &part[i]);
        if (over[i].degree == -2)
            return false;
    }
    return true;
}

/* Integrate n/prod f_i^power_i by partial fractions. */
static bool
integrate_fraction(qdot_integral_task *t, const qdot_poly *n, int factors, const qdot_poly *f, const int64_t *power,
                   qdot_expr x, qdot_primitive *out)
{
    qdot_poly whole, over[QDOT_READING_FACTORS];

    if (!qdot_rational_fractions(t, n, factors, f, power, &whole, over))
        return false;
    whole = qdot_poly_integral(t, &whole);
    if (whole.degree == -2)
        return false;
    out->rest = qdot_add(t->pool, out->rest, qdot_poly_expr(t, &whole, x));
    for (int i = 0; i < factors; i++)
        if (over[i].degree >= 0 && !integrate_over_power(t, over[i], &f[i], power[i], x, out))
            return false;
    return qdot_integral_goes(t);
}

bool
qdot_rational_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x, qdot_primitive *out)
{
    qdot_reading r;
    qdot_poly n, f[QDOT_READING_FACTORS];
    int64_t power[QDOT_READING_FACTORS];
    int step;

    *out = (qdot_primitive){.rest = QDOT_ZERO};
    if (!qdot_reading_make(t, e, x, &r) || r.n > 0)
        return false;
    n = qdot_poly_read(t, r.numerator, x);
    for (int i = 0; i < r.factors; i++) {
        f[i] = qdot_poly_read(t, r.factor[i].base, x);
        power[i] = r.factor[i].power;
        if (f[i].degree < 1)
            return false;
    }
    if (n.degree == -2)
        return false;
    n = qdot_poly_scale(t, &n, r.rest);
    step = r.factors == 0 ? 1 : common_step(&n, r.factors, f);
    if (step > 1) {
        qdot_expr xk = qdot_pow_int(t->pool, x, step);

        n = lower_step(&n, step, step - 1);
        n = qdot_poly_scale(t, &n, qdot_expr_ratio(t->pool, 1, step));
        e = qdot_div(t->pool, qdot_poly_expr(t, &n, x), QDOT_ONE);
        for (int i = 0; i < r.factors; i++) {
            f[i] = lower_step(&f[i], step, 0);
            e = qdot_div(t->pool, e, qdot_pow_int(t->pool, qdot_poly_expr(t, &f[i], x), power[i]));
        }
        if (!qdot_rational_integrate(t, e, x, out)) /* its denominator may factor now */
            return false;
        out->rest = qdot_subs(t->pool, out->rest, 1, &x, &xk);
        for (int i = 0; i < out->n; i++) {
            out->term[i].p = raise_step(&out->term[i].p, step);
            if (out->term[i].p.degree == -2)
                return false;
        }
        return true;
    }
    return integrate_fraction(t, &n, r.factors, f, power, x, out);
}

qdot_expr
qdot_rational_logs(qdot_integral_task *t, int n, qdot_expr *c, const qdot_expr *u)
{
    qdot_pool *pool = t->pool;
    qdot_expr sum = QDOT_ZERO;

    for (int i = 0; i < n; i++) {
        qdot_expr inside = u[i];

        if (c[i] == QDOT_ZERO)
            continue;
        for (int j = i + 1; j < n; j++) {
            if (c[j] == QDOT_ZERO)
                continue;
            if (c[j] == c[i])
                inside = qdot_mul(pool, inside, u[j]);
            else if (qdot_integral_normal(t, qdot_add(pool, c[j], c[i])) == QDOT_ZERO)
                inside = qdot_div(pool, inside, u[j]);
            else
                continue;
            c[j] = QDOT_ZERO;
        }
        sum = qdot_add(pool, sum, qdot_mul(pool, c[i], qdot_integral_log(t, inside)));
    }
    return sum;
}

qdot_expr
qdot_rational_write(qdot_integral_task *t, const qdot_primitive *f, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr sum = f->rest, c[QDOT_PRIMITIVE_TERMS], u[QDOT_PRIMITIVE_TERMS];
    int logs = 0;

    for (int i = 0; i < f->n; i++) {
        qdot_expr p = qdot_poly_expr(t, &f->term[i].p, x);

        if (f->term[i].angle) {
            p = qdot_fun1(pool, QDOT_ATAN, qdot_integral_normal(t, p));
            sum = qdot_add(pool, sum, qdot_mul(pool, f->term[i].c, p));
        } else {
            c[logs] = f->term[i].c;
            u[logs++] = p;
        }
    }
    return qdot_add(pool, sum, qdot_rational_logs(t, logs, c, u));
}

qdot_expr
qdot_rational_over(qdot_integral_task *t, qdot_expr e, qdot_expr w, qdot_expr is)
{
    qdot_primitive f;
    qdot_expr F;

    if (!qdot_rational_integrate(t, e, w, &f))
        return QDOT_NIL;
    F = qdot_rational_write(t, &f, w);
    return F == QDOT_NIL || is == w ? F : qdot_subs(t->pool, F, 1, &w, &is);
}
