/* residues.c -- integrates n/f, f irreducible, where the residues of all poles are rational or come in pairs u +- w.
 *
 * The residue at a root of f is the value there of s = n/f' mod f. Where s is free of x, n/f = s f'/f. Where s^2 = a s + b
 * modulo f, with a and b free of x, every residue is u + w or u - w with u = a/2 and w^2 = D = u^2 + b, and the roots of the one
 * kind are those of g = gcd(f, s - u - w), g = P + Q w:
 *
 *     D > 0:  (u + w) log|P + Q w| + (u - w) log|P - Q w|
 *     D < 0:  u log|f| + |w| i log((A + i B)/(A - i B)),   A = P, B = |w| Q
 *
 * The last term is a sum of arcs of polynomials, none of which jumps.
 *
 * Source  Trager (1976), Rothstein (1977), Rioboo (1991): Bronstein, Symbolic Integration I (2005), 2.5 to 2.8.
 */
#include "normal/integral/rational.h"

#include "expr/build.h"
#include "expr/exact.h"

/* A polynomial P + Q w in x whose coefficients hold w = sqrt(D). */
typedef struct {
    qdot_poly P, Q;
} pair;

typedef struct {
    qdot_integral_task *t;
    qdot_expr square; /* D */
} pairs;

static int
degree_of_pair(const pair *x)
{
    if (x->P.degree == -2 || x->Q.degree == -2)
        return -2;
    return x->P.degree > x->Q.degree ? x->P.degree : x->Q.degree;
}

/* The polynomial x times a + b w. */
static pair
scale_pair(const pairs *k, const pair *x, qdot_expr a, qdot_expr b)
{
    const qdot_poly aP = qdot_poly_scale(k->t, &x->P, a), aQ = qdot_poly_scale(k->t, &x->Q, a),
                    bP = qdot_poly_scale(k->t, &x->P, b),
                    bQ = qdot_poly_scale(k->t, &x->Q, qdot_mul(k->t->pool, b, k->square));

    return (pair){qdot_poly_add(k->t, &aP, &bQ), qdot_poly_add(k->t, &aQ, &bP)};
}

/* The polynomial x divided by its leading coefficient p + q w, which is times (p - q w)/(p^2 - q^2 w^2). */
static pair
make_monic(const pairs *k, const pair *x)
{
    qdot_pool *pool = k->t->pool;
    const int n = degree_of_pair(x);
    const qdot_expr p = qdot_poly_coefficient(&x->P, n), q = qdot_poly_coefficient(&x->Q, n);
    const qdot_expr norm = qdot_integral_normal(
        k->t, qdot_sub(pool, qdot_mul(pool, p, p), qdot_mul(pool, k->square, qdot_mul(pool, q, q))));

    return scale_pair(k, x, qdot_div(pool, p, norm), qdot_neg(pool, qdot_div(pool, q, norm)));
}

/* The rest of x divided by y, which is monic. */
static pair
rest_of_pair(const pairs *k, pair x, const pair *y)
{
    const int m = degree_of_pair(y);

    for (int n = degree_of_pair(&x); n >= m && qdot_integral_goes(k->t); n = degree_of_pair(&x)) {
        const qdot_poly power = qdot_poly_monomial(QDOT_ONE, n - m);
        pair z = scale_pair(k, y, qdot_poly_coefficient(&x.P, n), qdot_poly_coefficient(&x.Q, n));

        z = (pair){qdot_poly_mul(k->t, &z.P, &power), qdot_poly_mul(k->t, &z.Q, &power)};
        x = (pair){qdot_poly_sub(k->t, &x.P, &z.P), qdot_poly_sub(k->t, &x.Q, &z.Q)};
    }
    return x;
}

/* The monic greatest common divisor of x and y, by Euclid. */
static pair
common_divisor(const pairs *k, pair x, pair y)
{
    while (degree_of_pair(&y) >= 0 && qdot_integral_goes(k->t)) {
        const pair monic = make_monic(k, &y);

        y = rest_of_pair(k, x, &monic);
        x = monic;
    }
    return degree_of_pair(&y) == -1 ? x : (pair){y.P, y.Q};
}

/* c i log((A + i B)/(A - i B)), A and B without a common root, as arcs: with B D - A C = 1 it is
 * 2 c atan(A D + B C) + c i log((D + i C)/(D - i C)). */
static bool
add_arcs(qdot_integral_task *t, qdot_expr c, qdot_poly A, qdot_poly B, qdot_primitive *out)
{
    const qdot_poly one = qdot_poly_constant(t, QDOT_ONE);
    const qdot_expr twice = qdot_mul(t->pool, qdot_expr_int(t->pool, 2), c);

    while (qdot_integral_goes(t)) {
        qdot_poly quotient, rest, C, D, AD, BC;

        if (B.degree > A.degree) {
            rest = A;
            A = qdot_poly_scale(t, &B, QDOT_MINUS_ONE);
            B = rest;
        }
        if (A.degree < 0 || B.degree < 0)
            return false;
        qdot_poly_divide(t, &A, &B, &quotient, &rest);
        if (rest.degree == -1)
            return qdot_primitive_add(t, out, true, twice, quotient);
        D = qdot_poly_quotient_mod(t, &one, &B, &A);
        C = qdot_poly_mul(t, &B, &D);
        C = qdot_poly_sub(t, &C, &one);
        qdot_poly_divide(t, &C, &A, &C, &rest);
        AD = qdot_poly_mul(t, &A, &D);
        BC = qdot_poly_mul(t, &B, &C);
        if (!qdot_primitive_add(t, out, true, twice, qdot_poly_add(t, &AD, &BC)))
            return false;
        A = D;
        B = C;
    }
    return false;
}

/* a and b of s^2 = a s + b modulo f; false: there are none that are free of x. */
static bool
find_equation_of_residues(qdot_integral_task *t, const qdot_poly *s, const qdot_poly *f, qdot_expr *a, qdot_expr *b)
{
    qdot_poly square = qdot_poly_mul(t, s, s), quotient, rest;

    qdot_poly_divide(t, &square, f, &quotient, &square);
    *a = qdot_integral_normal(t, qdot_div(t->pool, qdot_poly_coefficient(&square, s->degree), s->c[s->degree]));
    rest = qdot_poly_scale(t, s, *a);
    rest = qdot_poly_sub(t, &square, &rest);
    *b = qdot_poly_coefficient(&rest, 0);
    return square.degree != -2 && rest.degree <= 0 && rest.degree != -2;
}

bool
qdot_residues_integrate(qdot_integral_task *t, const qdot_poly *n, const qdot_poly *f, qdot_primitive *out)
{
    qdot_pool *pool = t->pool;
    const qdot_poly df = qdot_poly_diff(t, f), s = qdot_poly_quotient_mod(t, n, &df, f);
    pairs k = {.t = t};
    qdot_expr a, b, u, w;
    qdot_poly shift;
    pair g;
    int sign;

    if (s.degree < 0)
        return false;
    if (s.degree == 0)
        return qdot_primitive_add(t, out, false, s.c[0], *f);
    if (!find_equation_of_residues(t, &s, f, &a, &b))
        return false;
    u = qdot_mul(pool, QDOT_HALF, a);
    k.square = qdot_integral_normal(t, qdot_add(pool, qdot_mul(pool, u, u), b));
    sign = qdot_integral_sign(t, k.square);
    w = sign == 0 ? QDOT_NIL : qdot_integral_root(t, sign > 0 ? k.square : qdot_neg(pool, k.square));
    if (w == QDOT_NIL)
        return false;
    shift = qdot_poly_constant(t, qdot_integral_normal(t, u));
    g = common_divisor(&k, (pair){*f, {.degree = -1}},
                       (pair){qdot_poly_sub(t, &s, &shift), qdot_poly_constant(t, QDOT_MINUS_ONE)});
    if (2 * degree_of_pair(&g) != f->degree)
        return false;
    g.Q = qdot_poly_scale(t, &g.Q, w);
    if (sign < 0)
        return qdot_primitive_add(t, out, false, u, *f) && add_arcs(t, w, g.P, g.Q, out);
    return qdot_primitive_add(t, out, false, qdot_add(pool, u, w), qdot_poly_add(t, &g.P, &g.Q)) &&
           qdot_primitive_add(t, out, false, qdot_sub(pool, u, w), qdot_poly_sub(t, &g.P, &g.Q));
}
