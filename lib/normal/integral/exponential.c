/* exponential.c -- integrates rational functions of x times powers of exp(u), u rational in x.
 *
 *     int g exp(u) = y exp(u),   y' + u' y = g,   y rational,
 *
 * if the integral is elementary at all (Liouville). At a pole of g of order a, y has one of order a - 1, of order a - b where
 * u' has one of order b; at infinity the degrees of g and u' bound that of y. What is left is a linear system for the
 * numerator of y.
 *
 * Source  Bronstein, Symbolic Integration I (2005), 6.1-6.5
 * Tests   tests/normal/integral/test_antiderivative.c
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"
#include "normal/integral/polynomial.h"
#include "normal/integral/rational.h"

/* A quotient of polynomials whose denominator is a product of powers of irreducible ones. */
typedef struct {
    qdot_poly over, under;
    int factors;
    qdot_poly factor[QDOT_READING_FACTORS];
    int64_t power[QDOT_READING_FACTORS];
} fraction;

static bool
add_factor(qdot_integral_task *t, fraction *f, const qdot_poly *p, int64_t power)
{
    const qdot_poly raised = qdot_poly_power(t, p, power);

    if (f->factors == QDOT_READING_FACTORS || p->degree < 1 || raised.degree == -2)
        return false;
    f->under = qdot_poly_mul(t, &f->under, &raised);
    f->factor[f->factors] = *p;
    f->power[f->factors++] = power;
    return f->under.degree != -2;
}

static bool
read_fraction(qdot_integral_task *t, qdot_expr e, qdot_expr x, fraction *f)
{
    qdot_reading r;

    if (!qdot_reading_make(t, e, x, &r) || r.n > 0)
        return false;
    *f = (fraction){.over = qdot_poly_read(t, qdot_mul(t->pool, r.rest, r.numerator), x), .under = qdot_poly_constant(t, QDOT_ONE)};
    for (int i = 0; i < r.factors; i++) {
        const qdot_poly p = qdot_poly_read(t, r.factor[i].base, x);

        if (!add_factor(t, f, &p, r.factor[i].power))
            return false;
    }
    return f->over.degree >= 0;
}

/* The order of the pole of f at the zeros of p. */
static int64_t
order_at(qdot_integral_task *t, const fraction *f, const qdot_poly *p)
{
    for (int i = 0; i < f->factors; i++) {
        qdot_poly quotient, rest;

        if (f->factor[i].degree != p->degree)
            continue;
        qdot_poly_divide(t, &f->factor[i], p, &quotient, &rest);
        if (rest.degree == -1)
            return f->power[i];
    }
    return 0;
}

/* A basis of polynomials by degree; each is L(combination), L linear. */
typedef struct {
    qdot_poly value[QDOT_POLY_MOST + 1], combination[QDOT_POLY_MOST + 1];
    bool has[QDOT_POLY_MOST + 1];
} basis;

/* Reduce p by the basis, and with it what it is made of; false: too large. */
static bool
reduce_by_basis(qdot_integral_task *t, const basis *b, qdot_poly *p, qdot_poly *combination)
{
    for (int n = p->degree; n >= 0 && p->degree >= 0; n--) {
        qdot_expr c;
        qdot_poly v, m;

        if (p->degree != n || !b->has[n])
            continue;
        c = qdot_integral_normal(t, qdot_div(t->pool, p->c[n], b->value[n].c[n]));
        v = qdot_poly_scale(t, &b->value[n], c);
        m = qdot_poly_scale(t, &b->combination[n], c);
        *p = qdot_poly_sub(t, p, &v);
        *combination = qdot_poly_sub(t, combination, &m);
    }
    return p->degree != -2 && combination->degree != -2 && qdot_integral_goes(t);
}

/* The numerator N of y = N/Q, of degree up to `most`, from  B D (N' Q - N Q') + A D N Q = G B Q^2  with f = A/B, g = G/D. */
static bool
solve_numerator(qdot_integral_task *t, const fraction *f, const fraction *g, const qdot_poly *Q, int most, qdot_poly *N)
{
    const qdot_poly BD = qdot_poly_mul(t, &f->under, &g->under), AD = qdot_poly_mul(t, &f->over, &g->under),
                    dQ = qdot_poly_diff(t, Q), ADQ = qdot_poly_mul(t, &AD, Q), BDQ = qdot_poly_mul(t, &BD, Q),
                    BDdQ = qdot_poly_mul(t, &BD, &dQ);
    qdot_poly right = qdot_poly_mul(t, &g->over, &f->under), none = {.degree = -1};
    basis b = {.has = {false}};

    right = qdot_poly_mul(t, &right, Q);
    right = qdot_poly_mul(t, &right, Q);
    for (int k = 0; k <= most; k++) {
        qdot_poly combination = qdot_poly_monomial(QDOT_ONE, k), d = qdot_poly_diff(t, &combination), L, part;

        L = qdot_poly_mul(t, &d, &BDQ);
        part = qdot_poly_mul(t, &combination, &BDdQ);
        L = qdot_poly_sub(t, &L, &part);
        part = qdot_poly_mul(t, &combination, &ADQ);
        L = qdot_poly_add(t, &L, &part);
        if (L.degree == -2 || !reduce_by_basis(t, &b, &L, &combination))
            return false;
        if (L.degree < 0)
            continue;
        b.value[L.degree] = L;
        b.combination[L.degree] = combination;
        b.has[L.degree] = true;
    }
    if (right.degree == -2 || !reduce_by_basis(t, &b, &right, &none) || right.degree >= 0)
        return false;
    *N = qdot_poly_scale(t, &none, QDOT_MINUS_ONE);
    return N->degree != -2;
}

/* y with y' + f y = g; nil: there is none. */
static qdot_expr
solve_for_factor(qdot_integral_task *t, qdot_expr f_expr, qdot_expr g_expr, qdot_expr x)
{
    qdot_poly Q = qdot_poly_constant(t, QDOT_ONE), N;
    fraction f, g;
    int degree_f, degree_g, degree;

    if (!read_fraction(t, f_expr, x, &f) || !read_fraction(t, g_expr, x, &g))
        return QDOT_NIL;
    for (int i = 0; i < g.factors; i++) {
        const int64_t order = g.power[i] - (order_at(t, &f, &g.factor[i]) > 0 ? order_at(t, &f, &g.factor[i]) : 1);
        const qdot_poly raised = qdot_poly_power(t, &g.factor[i], order > 0 ? order : 0);

        Q = qdot_poly_mul(t, &Q, &raised);
    }
    degree_f = f.over.degree - f.under.degree;
    degree_g = g.over.degree - g.under.degree;
    degree = degree_f >= 0 ? degree_g - degree_f : degree_g >= 0 ? degree_g + 1 : 0;
    degree += Q.degree;
    if (Q.degree < 0 || degree < 0 || degree > QDOT_POLY_MOST || !solve_numerator(t, &f, &g, &Q, degree, &N))
        return QDOT_NIL;
    return qdot_div(t->pool, qdot_poly_expr(t, &N, x), qdot_poly_expr(t, &Q, x));
}

qdot_expr
qdot_exponential_rational_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr E, u, under = QDOT_ONE, F = QDOT_ZERO, du;
    qdot_poly over;
    int64_t lower = 0;

    if (r->n != 1 || r->generator[0].kind != QDOT_GEN_EXP)
        return QDOT_NIL;
    E = r->generator[0].symbol;
    u = r->generator[0].of;
    du = qdot_diff(pool, u, x);
    for (int i = 0; i < r->factors; i++) {
        if (r->factor[i].base == E)
            lower = r->factor[i].power;
        else if (qdot_expr_contains(pool, r->factor[i].base, E))
            return QDOT_NIL;
        else
            under = qdot_mul(pool, under, qdot_pow_int(pool, r->factor[i].base, r->factor[i].power));
    }
    over = qdot_poly_read(t, r->numerator, E);
    for (int j = 0; j <= over.degree && F != QDOT_NIL; j++) {
        const qdot_expr power = qdot_expr_int(pool, j - lower), g = qdot_div(pool, qdot_mul(pool, r->rest, over.c[j]), under);
        qdot_expr y;

        if (over.c[j] == QDOT_ZERO)
            continue;
        if (j == lower) {
            y = qdot_rational_over(t, g, x, x);
        } else {
            y = solve_for_factor(t, qdot_mul(pool, power, du), g, x);
            y = y == QDOT_NIL ? y : qdot_mul(pool, y, qdot_fun1(pool, QDOT_EXP, qdot_mul(pool, power, u)));
        }
        F = y == QDOT_NIL ? y : qdot_add(pool, F, y);
    }
    return over.degree < 0 ? QDOT_NIL : F;
}
