/* loop-residues.c -- the loop of sqrt(Q) times a rational function by residues, Q of degree 2. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "normal/integral/loop-parts.h"
#include "normal/integral/rational.h"

typedef struct {
    qdot_loop_task *l;
    qdot_integral_task *t;
    qdot_pool *pool;
    const qdot_poly *Q;
    qdot_expr A, m, d2; /* Q = A (d^2 - (u - m)^2) */
    qdot_expr sum;      /* what is found, over 2 pi */
} residues;

/* Add c to what is found; times 2 pi it is a part of the loop. */
static void
add_part(residues *r, qdot_expr c)
{
    r->sum = qdot_add(r->pool, r->sum, c);
}

/* The polynomial in u as one in u - s: c[k] is the coefficient of (u - s)^k. */
static qdot_poly
about(residues *r, const qdot_poly *p, qdot_expr s)
{
    qdot_poly shift = qdot_poly_linear(r->t, QDOT_ONE, s), sum = qdot_poly_constant(r->t, qdot_poly_coefficient(p, p->degree));

    for (int i = p->degree - 1; i >= 0; i--) {
        const qdot_poly c = qdot_poly_constant(r->t, p->c[i]);

        sum = qdot_poly_mul(r->t, &sum, &shift);
        sum = qdot_poly_add(r->t, &sum, &c);
    }
    return sum;
}

/* A polynomial: moments of the half circle, int_-d^d sqrt(d^2 - v^2) v^2j dv = pi d^(2j+2) (2j)!/(2^(2j+1) j! (j+1)!). */
static bool
add_moments(residues *r, const qdot_poly *whole)
{
    qdot_pool *pool = r->pool;
    qdot_poly p;
    qdot_expr moment = QDOT_HALF; /* (2j)!/(2^(2j+1) j! (j+1)!) */

    if (whole->degree < 0)
        return whole->degree == -1;
    p = about(r, whole, r->m);
    for (int k = 0; k <= p.degree; k += 2) {
        if (k > 0)
            moment = qdot_mul(pool, moment, qdot_expr_ratio(pool, k - 1, k + 2));
        add_part(r, qdot_product(pool, 4, (qdot_expr[]){qdot_sqrt(pool, r->A), p.c[k], moment,
                                                         qdot_pow_int(pool, r->d2, k / 2 + 1)}));
    }
    return p.degree != -2;
}

/* Add the part of over/(f1 (u - s))^power, s real. */
static bool
add_real_pole(residues *r, const qdot_poly *over, qdot_expr f1, qdot_expr s, int64_t power)
{
    qdot_pool *pool = r->pool;
    const qdot_expr at = qdot_integral_variable(r->t, false);
    const int sigma = qdot_loop_sign(r->l, qdot_sub(pool, r->m, s));
    qdot_poly p = about(r, over, s);
    qdot_expr simple, root;

    if (sigma == 0 || p.degree == -2)
        return false;
    root = qdot_sqrt(pool, qdot_integral_normal(r->t, qdot_neg(pool, qdot_poly_expr(r->t, r->Q, at))));
    simple = qdot_sub(pool, qdot_mul(pool, qdot_sqrt(pool, r->A), qdot_sub(pool, r->m, at)),
                      qdot_mul(pool, qdot_expr_int(pool, sigma), root));
    for (int64_t order = 1; order <= power; order++) { /* of (u - s)^-order: derivative number order - 1 over (order - 1)! */
        const qdot_expr c = qdot_poly_coefficient(&p, (int)(power - order));
        qdot_expr value;

        if (order > 1)
            simple = qdot_div(pool, qdot_diff(pool, simple, at), qdot_expr_int(pool, order - 1));
        if (c == QDOT_ZERO)
            continue;
        value = qdot_integral_normal(r->t, qdot_poly_at(r->t, r->Q, s));
        if (value == QDOT_ZERO && order > 1)
            return false;
        add_part(r, qdot_mul(pool, qdot_div(pool, c, qdot_pow_int(pool, f1, power)),
                             qdot_subs(pool, simple, 1, &at, &s)));
    }
    return true;
}

/* Add the part of over/f, over of degree 1, f of degree 2 with the zeros h +- iw, h = m. */
static bool
add_complex_pair(residues *r, const qdot_poly *over, const qdot_poly *f, qdot_expr h, qdot_expr w)
{
    qdot_pool *pool = r->pool;
    qdot_expr c, root;

    if (!qdot_integral_zero(r->t, qdot_sub(pool, h, r->m)))
        return false;
    root = qdot_sqrt(pool, qdot_mul(pool, r->A, qdot_add(pool, qdot_mul(pool, w, w), r->d2)));
    c = qdot_div(pool, qdot_poly_at(r->t, over, h), qdot_mul(pool, w, f->c[2]));
    add_part(r, qdot_mul(pool, c, qdot_sub(pool, root, qdot_mul(pool, qdot_sqrt(pool, r->A), w))));
    return true;
}

/* Add the part of over/f^power, f irreducible over the parameters. */
static bool
add_pole(residues *r, const qdot_poly *over, const qdot_poly *f, int64_t power)
{
    qdot_pool *pool = r->pool;
    qdot_expr h, disc, w, slope, two_a;

    if (over->degree < 0)
        return over->degree == -1;
    if (f->degree == 1)
        return add_real_pole(r, over, f->c[1], qdot_integral_normal(r->t, qdot_div(pool, qdot_neg(pool, f->c[0]), f->c[1])), power);
    if (f->degree != 2 || power != 1)
        return false;
    two_a = qdot_mul(pool, qdot_expr_int(pool, 2), f->c[2]);
    h = qdot_integral_normal(r->t, qdot_div(pool, qdot_neg(pool, f->c[1]), two_a));
    disc = qdot_integral_normal(r->t, qdot_sub(pool, qdot_mul(pool, h, h), qdot_div(pool, f->c[0], f->c[2])));
    switch (qdot_loop_sign(r->l, disc)) {
    case -1: return add_complex_pair(r, over, f, h, qdot_sqrt(pool, qdot_neg(pool, disc)));
    case 1: break;
    default: return false;
    }
    w = qdot_sqrt(pool, disc);
    for (int i = -1; i <= 1; i += 2) { /* residue n(s)/f'(s) */
        const qdot_expr s = qdot_add(pool, h, qdot_mul(pool, qdot_expr_int(pool, i), w));
        qdot_poly c;

        slope = qdot_mul(pool, two_a, qdot_sub(pool, s, h));
        c = qdot_poly_constant(r->t, qdot_div(pool, qdot_poly_at(r->t, over, s), slope));
        if (!add_real_pole(r, &c, QDOT_ONE, s, 1))
            return false;
    }
    return true;
}

/* The sign of H between the zeros of Q, by that in the middle. */
static int
sign_of_factor(residues *r, const qdot_loop_square *s)
{
    int sign = s->over.degree > 0 ? qdot_loop_sign(r->l, qdot_poly_at(r->t, &s->over, r->m))
                                  : qdot_loop_sign(r->l, s->over.c[0]);

    for (int i = 0; i < s->n && sign != 0; i++)
        if (s->power[i] % 2 != 0)
            sign *= qdot_loop_sign(r->l, qdot_poly_at(r->t, &s->base[i], r->m));
    return sign;
}

qdot_expr
qdot_loop_residues(qdot_loop_task *l, const qdot_loop_square *s)
{
    qdot_pool *pool = l->pool;
    residues r = {.l = l, .t = &l->t, .pool = pool, .Q = &s->Q, .sum = QDOT_ZERO};
    qdot_poly whole, over[QDOT_READING_FACTORS];
    int sign;

    r.A = qdot_integral_normal(r.t, qdot_neg(pool, s->Q.c[2]));
    r.m = qdot_integral_normal(r.t, qdot_div(pool, s->Q.c[1], qdot_mul(pool, qdot_expr_int(pool, 2), r.A)));
    r.d2 = qdot_integral_normal(r.t, qdot_div(pool, qdot_poly_at(r.t, &s->Q, r.m), r.A));
    sign = sign_of_factor(&r, s);
    if (sign == 0 || !qdot_rational_fractions(r.t, &s->over, s->n, s->base, s->power, &whole, over) || !add_moments(&r, &whole))
        return QDOT_NIL;
    for (int i = 0; i < s->n; i++)
        if (!add_pole(&r, &over[i], &s->base[i], s->power[i]))
            return QDOT_NIL;
    return qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2 * sign), QDOT_PI, r.sum});
}
