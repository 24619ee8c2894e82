/* polynomial.c -- arithmetic of polynomials in one variable over expressions. */
#include "normal/integral/polynomial.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"

static const qdot_poly too_large = {.degree = -2};

/* Put coefficients in normal form and drop leading zeros. */
static qdot_poly
poly_trim(qdot_integral_task *t, qdot_poly p)
{
    for (int i = 0; i <= p.degree; i++) {
        p.c[i] = qdot_integral_normal(t, p.c[i]);
        if (p.c[i] == QDOT_NIL)
            return too_large;
    }
    while (p.degree >= 0 && qdot_integral_zero(t, p.c[p.degree]))
        p.degree--;
    return p;
}

qdot_poly
qdot_poly_constant(qdot_integral_task *t, qdot_expr c)
{
    return poly_trim(t, (qdot_poly){.degree = 0, .c = {c}});
}

qdot_poly
qdot_poly_linear(qdot_integral_task *t, qdot_expr a, qdot_expr b)
{
    return poly_trim(t, (qdot_poly){.degree = 1, .c = {b, a}});
}

qdot_poly
qdot_poly_monomial(qdot_expr c, int n)
{
    qdot_poly p = {.degree = n};

    for (int i = 0; i < n; i++)
        p.c[i] = QDOT_ZERO;
    p.c[n] = c;
    return p;
}

qdot_expr
qdot_poly_coefficient(const qdot_poly *p, int i)
{
    return i <= p->degree ? p->c[i] : QDOT_ZERO;
}

qdot_poly
qdot_poly_read(qdot_integral_task *t, qdot_expr e, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_poly p = {.degree = -1};
    uint32_t n;

    e = qdot_collect(pool, e, x);
    if (e == QDOT_NIL)
        return too_large;
    for (int i = 0; i <= QDOT_POLY_MOST; i++)
        p.c[i] = QDOT_ZERO;
    n = qdot_expr_kind(pool, e) == QDOT_SUM ? qdot_expr_count(pool, e) : 1;
    for (uint32_t i = 0; i < n; i += i == 0 ? 1 : 2) {
        qdot_expr term = n == 1 ? e : qdot_expr_arg(pool, e, i), power = QDOT_ZERO, rest;
        int64_t k = 0;

        if (n > 1 && i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, e, i + 1));
        if (term == x)
            power = QDOT_ONE;
        else if (qdot_expr_kind(pool, term) == QDOT_PROD)
            for (uint32_t j = 1; j < qdot_expr_count(pool, term); j += 2)
                if (qdot_expr_arg(pool, term, j) == x)
                    power = qdot_expr_arg(pool, term, j + 1);
        if (!qdot_expr_to_int(pool, power, &k) || k < 0 || k > QDOT_POLY_MOST)
            return too_large;
        rest = qdot_div(pool, term, qdot_pow_int(pool, x, k));
        if (rest == QDOT_NIL || qdot_expr_contains(pool, rest, x))
            return too_large;
        p.c[k] = qdot_add(pool, p.c[k], rest);
        p.degree = k > p.degree ? (int)k : p.degree;
    }
    return poly_trim(t, p);
}

bool
qdot_poly_read_root(qdot_integral_task *t, qdot_expr e, qdot_expr V, qdot_expr square, qdot_expr *lo, qdot_expr *hi)
{
    qdot_pool *pool = t->pool;
    qdot_poly p = qdot_poly_read(t, e, V);

    *lo = *hi = QDOT_ZERO;
    for (int i = 0; i <= p.degree; i++) {
        qdot_expr *to = i % 2 == 0 ? lo : hi;

        *to = qdot_add(pool, *to, qdot_mul(pool, p.c[i], qdot_pow_int(pool, square, i / 2)));
    }
    return p.degree != -2;
}

qdot_expr
qdot_poly_expr(qdot_integral_task *t, const qdot_poly *p, qdot_expr x)
{
    qdot_expr sum = QDOT_ZERO;

    if (p->degree == -2)
        return QDOT_NIL;
    for (int i = 0; i <= p->degree; i++)
        sum = qdot_add(t->pool, sum, qdot_mul(t->pool, p->c[i], qdot_pow_int(t->pool, x, i)));
    return sum;
}

static qdot_poly
poly_combine(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b, bool minus)
{
    qdot_poly r = {.degree = a->degree > b->degree ? a->degree : b->degree};

    if (a->degree == -2 || b->degree == -2)
        return too_large;
    for (int i = 0; i <= r.degree; i++) {
        qdot_expr u = qdot_poly_coefficient(a, i), v = qdot_poly_coefficient(b, i);

        r.c[i] = minus ? qdot_sub(t->pool, u, v) : qdot_add(t->pool, u, v);
    }
    return poly_trim(t, r);
}

qdot_poly
qdot_poly_add(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b)
{
    return poly_combine(t, a, b, false);
}

qdot_poly
qdot_poly_sub(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b)
{
    return poly_combine(t, a, b, true);
}

qdot_poly
qdot_poly_mul(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b)
{
    qdot_poly r = {.degree = a->degree + b->degree};

    if (a->degree == -2 || b->degree == -2 || r.degree > QDOT_POLY_MOST)
        return too_large;
    if (a->degree < 0 || b->degree < 0)
        return (qdot_poly){.degree = -1};
    for (int k = 0; k <= r.degree; k++) {
        r.c[k] = QDOT_ZERO;
        for (int i = k > b->degree ? k - b->degree : 0; i <= a->degree && i <= k; i++)
            r.c[k] = qdot_add(t->pool, r.c[k], qdot_mul(t->pool, a->c[i], b->c[k - i]));
    }
    return poly_trim(t, r);
}

qdot_poly
qdot_poly_scale(qdot_integral_task *t, const qdot_poly *a, qdot_expr c)
{
    qdot_poly r = *a;

    for (int i = 0; i <= r.degree; i++)
        r.c[i] = qdot_mul(t->pool, r.c[i], c);
    return poly_trim(t, r);
}

qdot_poly
qdot_poly_power(qdot_integral_task *t, const qdot_poly *a, int64_t n)
{
    qdot_poly r = qdot_poly_constant(t, QDOT_ONE);

    for (int64_t i = 0; i < n && r.degree != -2; i++)
        r = qdot_poly_mul(t, &r, a);
    return r;
}

qdot_poly
qdot_poly_diff(qdot_integral_task *t, const qdot_poly *a)
{
    qdot_poly r = {.degree = a->degree <= 0 ? (a->degree == -2 ? -2 : -1) : a->degree - 1};

    for (int i = 1; i <= a->degree; i++)
        r.c[i - 1] = qdot_mul(t->pool, qdot_expr_int(t->pool, i), a->c[i]);
    return poly_trim(t, r);
}

qdot_poly
qdot_poly_integral(qdot_integral_task *t, const qdot_poly *a)
{
    qdot_poly r = {.degree = a->degree < 0 ? a->degree : a->degree + 1};

    if (r.degree > QDOT_POLY_MOST)
        return too_large;
    r.c[0] = QDOT_ZERO;
    for (int i = 0; i <= a->degree; i++)
        r.c[i + 1] = qdot_div(t->pool, a->c[i], qdot_expr_int(t->pool, i + 1));
    return poly_trim(t, r);
}

void
qdot_poly_divide(qdot_integral_task *t, const qdot_poly *a, const qdot_poly *b, qdot_poly *quotient,
                 qdot_poly *rest)
{
    qdot_poly q = {.degree = a->degree - b->degree}, r = *a, m = *b;
    qdot_expr over;

    if (a->degree == -2 || m.degree < 0) {
        *quotient = *rest = too_large;
        return;
    }
    if (q.degree < 0)
        q.degree = -1;
    over = qdot_div(t->pool, QDOT_ONE, m.c[m.degree]);
    for (int i = 0; i <= q.degree; i++)
        q.c[i] = QDOT_ZERO;
    while (r.degree >= m.degree && qdot_integral_goes(t)) {
        int shift = r.degree - m.degree;
        qdot_expr c = qdot_integral_normal(t, qdot_mul(t->pool, r.c[r.degree], over));

        q.c[shift] = c;
        for (int i = 0; i < m.degree; i++)
            r.c[i + shift] = qdot_sub(t->pool, r.c[i + shift], qdot_mul(t->pool, c, m.c[i]));
        r.degree--;
        r = poly_trim(t, r);
    }
    *quotient = poly_trim(t, q);
    *rest = r;
}

qdot_poly
qdot_poly_quotient_mod(qdot_integral_task *t, const qdot_poly *c, const qdot_poly *a, const qdot_poly *m)
{
    /* s0 a = r0, s1 a = r1 modulo m */
    qdot_poly r0 = *m, r1, s0 = {.degree = -1}, s1 = qdot_poly_constant(t, QDOT_ONE), q, r, u;

    qdot_poly_divide(t, a, m, &q, &r1);
    while (r1.degree > 0 && qdot_integral_goes(t)) {
        qdot_poly_divide(t, &r0, &r1, &q, &r);
        u = qdot_poly_mul(t, &q, &s1);
        u = qdot_poly_sub(t, &s0, &u);
        r0 = r1;
        r1 = r;
        s0 = s1;
        s1 = u;
    }
    if (r1.degree != 0)
        return too_large;
    s1 = qdot_poly_scale(t, &s1, qdot_div(t->pool, QDOT_ONE, r1.c[0]));
    s1 = qdot_poly_mul(t, &s1, c);
    qdot_poly_divide(t, &s1, m, &q, &r);
    return r;
}

qdot_expr
qdot_poly_at(qdot_integral_task *t, const qdot_poly *a, qdot_expr x)
{
    qdot_expr v = QDOT_ZERO;

    for (int i = a->degree; i >= 0; i--)
        v = qdot_add(t->pool, qdot_mul(t->pool, v, x), a->c[i]);
    return qdot_integral_normal(t, v);
}
