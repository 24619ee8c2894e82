/* gauss.c -- integrates polynomials times exp(-a x^2 + b x + c), by the error function.
 *
 *     int P exp(u) = S exp(u) + lambda int exp(u),   P = S' + S u' + lambda
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"
#include "normal/integral/polynomial.h"

qdot_expr
qdot_gauss_integrate(qdot_integral_task *t, const qdot_reading *r, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_poly u, du, E, P, S = {.degree = -1};
    qdot_expr F, s, k, e = r->n == 1 ? r->generator[0].expr : QDOT_NIL, u_expr;
    int sign;

    if (r->n != 1 || r->generator[0].kind != QDOT_GEN_EXP || r->factors > 1)
        return QDOT_NIL;
    E = qdot_poly_read(t, r->numerator, r->generator[0].symbol);
    u_expr = r->generator[0].of;
    if (E.degree < 1) { /* over a power of the exponential */
        if (r->factors != 1 || r->factor[0].base != r->generator[0].symbol || E.degree != 0)
            return QDOT_NIL;
        u_expr = qdot_mul(pool, u_expr, qdot_expr_int(pool, -r->factor[0].power));
        e = qdot_pow_int(pool, e, -r->factor[0].power);
        P = qdot_poly_read(t, E.c[0], x);
    } else {
        for (int i = 0; i < E.degree; i++)
            if (E.c[i] != QDOT_ZERO)
                return QDOT_NIL;
        if (r->factors != 0)
            return QDOT_NIL;
        u_expr = qdot_mul(pool, u_expr, qdot_expr_int(pool, E.degree));
        e = qdot_pow_int(pool, e, E.degree);
        P = qdot_poly_read(t, E.c[E.degree], x);
    }
    u = qdot_poly_read(t, u_expr, x);
    if (u.degree != 2 || P.degree < 0)
        return QDOT_NIL;
    P = qdot_poly_scale(t, &P, r->rest);
    du = qdot_poly_diff(t, &u);
    while (P.degree >= 1 && qdot_integral_goes(t)) {
        int n = P.degree - 1;
        qdot_poly c = qdot_poly_monomial(qdot_integral_normal(t, qdot_div(pool, P.c[P.degree], du.c[1])), n), v, w;

        v = qdot_poly_diff(t, &c);
        w = qdot_poly_mul(t, &c, &du);
        P = qdot_poly_sub(t, &P, &v);
        P = qdot_poly_sub(t, &P, &w);
        S = qdot_poly_add(t, &S, &c);
    }
    F = qdot_mul(pool, qdot_poly_expr(t, &S, x), e);
    if (P.degree < 0)
        return P.degree == -1 ? F : QDOT_NIL;
    sign = qdot_integral_sign(t, u.c[2]);
    if (sign >= 0)
        return QDOT_NIL;
    s = qdot_integral_normal(t, qdot_sqrt(pool, qdot_neg(pool, u.c[2])));
    /* u = -(s x - k)^2 + k^2 + c,  k = b/(2 s) */
    k = qdot_div(pool, u.c[1], qdot_mul(pool, qdot_expr_int(pool, 2), s));
    e = qdot_fun1(pool, QDOT_EXP, qdot_integral_normal(t, qdot_add(pool, u.c[0], qdot_mul(pool, k, k))));
    e = qdot_mul(pool, e, qdot_div(pool, qdot_sqrt(pool, QDOT_PI), qdot_mul(pool, qdot_expr_int(pool, 2), s)));
    k = qdot_fun1(pool, QDOT_ERF, qdot_integral_normal(t, qdot_sub(pool, qdot_mul(pool, s, x), k)));
    return qdot_add(pool, F, qdot_mul(pool, P.c[0], qdot_mul(pool, e, k)));
}
