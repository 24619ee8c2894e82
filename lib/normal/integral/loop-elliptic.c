/* loop-elliptic.c -- loops that are complete elliptic integrals. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "normal/integral/loop-parts.h"
#include "normal/integral/methods.h"

/* p K(m) + q E(m) */
static qdot_expr
complete(qdot_pool *pool, qdot_expr p, qdot_expr q, qdot_expr m)
{
    return qdot_add(pool, qdot_mul(pool, p, qdot_fun1(pool, QDOT_ELLIPTIC_K, m)),
                    qdot_mul(pool, q, qdot_fun1(pool, QDOT_ELLIPTIC_E, m)));
}

/* a + k b */
static qdot_expr
combined(qdot_pool *pool, qdot_expr a, int64_t k, qdot_expr b)
{
    return qdot_add(pool, a, qdot_mul(pool, qdot_expr_int(pool, k), b));
}

qdot_expr
qdot_loop_biquadratic(qdot_loop_task *l, const qdot_loop_square *s, bool both)
{
    qdot_pool *pool = l->pool;
    const qdot_poly *Q = &s->Q;
    const int rising = qdot_loop_sign(l, Q->c[4]), at_zero = qdot_loop_sign(l, Q->c[0]);
    qdot_expr A, middle, disc, root, large, small, value, whole;

    if (s->n > 0 || s->over.degree != 0 || Q->c[1] != QDOT_ZERO || Q->c[3] != QDOT_ZERO || rising == 0 || at_zero == 0)
        return QDOT_NIL;
    A = qdot_integral_normal(&l->t, qdot_mul(pool, qdot_expr_int(pool, rising), Q->c[4]));
    middle = qdot_integral_normal(&l->t, qdot_div(pool, Q->c[2], qdot_mul(pool, qdot_expr_int(pool, -2), Q->c[4])));
    disc = qdot_integral_normal(&l->t, qdot_sub(pool, qdot_mul(pool, middle, middle), qdot_div(pool, Q->c[0], Q->c[4])));
    root = qdot_sqrt(pool, disc);
    large = qdot_add(pool, middle, root); /* the zeros of Q over u^2 */
    small = qdot_sub(pool, middle, root);
    if (both && rising < 0 && at_zero > 0) { /* b^2 = large, a^2 = -small */
        whole = qdot_mul(pool, qdot_expr_int(pool, 2), root);
        value = complete(pool, qdot_neg(pool, small), combined(pool, large, 1, small), qdot_div(pool, large, whole));
        value = qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, qdot_sqrt(pool, whole), value));
    } else if (!both && rising < 0 && at_zero < 0) { /* b^2 = large, a^2 = small */
        value = complete(pool, qdot_mul(pool, qdot_expr_int(pool, -2), small), combined(pool, large, 1, small),
                         qdot_sub(pool, QDOT_ONE, qdot_div(pool, small, large)));
        value = qdot_mul(pool, qdot_expr_int(pool, 2), qdot_mul(pool, qdot_sqrt(pool, large), value));
    } else if (both && rising > 0 && at_zero > 0) { /* a^2 = small, b^2 = large */
        value = complete(pool, combined(pool, small, -1, large), combined(pool, small, 1, large), qdot_div(pool, small, large));
        value = qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, qdot_sqrt(pool, large), value));
    } else {
        return QDOT_NIL;
    }
    value = qdot_mul(pool, value, qdot_mul(pool, qdot_sqrt(pool, A), qdot_fun1(pool, QDOT_ABS, s->over.c[0])));
    return qdot_mul(pool, value, qdot_expr_ratio(pool, 1, 3));
}

/* The read expression as c + b V for its only function of x, a sine or cosine of kx + ...; k nil: it is another. */
static qdot_expr
read_wave(qdot_loop_task *l, const qdot_reading *r, qdot_expr *c, qdot_expr *b)
{
    qdot_poly p;

    if (r->n != 1 || r->bare || r->factors > 0 || (r->generator[0].kind != QDOT_GEN_COS && r->generator[0].kind != QDOT_GEN_SIN))
        return QDOT_NIL;
    p = qdot_poly_read(&l->t, qdot_mul(l->pool, r->rest, r->numerator), r->generator[0].symbol);
    if (p.degree != 1)
        return QDOT_NIL;
    *c = p.c[0];
    *b = p.c[1];
    return qdot_integral_slope(l->pool, r->generator[0].of, l->x);
}

qdot_expr
qdot_loop_pendulum(qdot_loop_task *l, const qdot_reading *r)
{
    qdot_pool *pool = l->pool;
    qdot_expr c = QDOT_NIL, b = QDOT_NIL, k = read_wave(l, r, &c, &b), sum, twice, m;
    int sign;

    if (k == QDOT_NIL || (sign = qdot_loop_sign(l, b)) == 0)
        return QDOT_NIL;
    b = qdot_mul(pool, qdot_expr_int(pool, sign), b);
    sum = qdot_integral_normal(&l->t, qdot_add(pool, c, b));
    twice = qdot_mul(pool, qdot_expr_int(pool, 2), b);
    if (l->lo == QDOT_NIL)
        return qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), qdot_sqrt(pool, sum),
                                                    qdot_fun1(pool, QDOT_ELLIPTIC_E, qdot_div(pool, twice, sum))});
    m = qdot_div(pool, sum, twice);
    return qdot_product(pool, 4, (qdot_expr[]){qdot_expr_int(pool, 8), qdot_sqrt(pool, twice),
                                                complete(pool, qdot_sub(pool, m, QDOT_ONE), QDOT_ONE, m),
                                                qdot_pow_int(pool, qdot_fun1(pool, QDOT_ABS, k), -1)});
}
