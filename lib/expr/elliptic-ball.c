/* elliptic-ball.c -- Legendre's elliptic integrals and Jacobi's functions in ball (interval) arithmetic. */
#include "expr/elliptic-ball.h"

/* Whether c sin(x)^2 < 1 from 0 to phi (NULL: pi/2) is known; `closed`: or = 1. */
static bool
stays_below_one(const arb_t c, const arb_struct *phi, bool closed, slong bits)
{
    bool below;
    arb_t one, half, s;

    arb_init(one);
    arb_init(half);
    arb_init(s);
    arb_one(one);
    below = (closed ? arb_le : arb_lt)(c, one);
    if (!below && phi != NULL) {
        arb_const_pi(half, bits);
        arb_mul_2exp_si(half, half, -1);
        arb_abs(s, phi);
        if (arb_lt(s, half)) {
            arb_sin(s, phi, bits);
            arb_mul(s, s, s, bits);
            arb_mul(s, s, c, bits);
            below = arb_lt(s, one);
        }
    }
    arb_clear(one);
    arb_clear(half);
    arb_clear(s);
    return below;
}

/* y = am(u, m), m < 1, by the means a_n, b_n of 1 and sqrt(1 - m): F(am, m) = F(phi, 1 - (b/a)^2)/(2^n a), so
 * phi lies between 2^n b u and 2^n a u, from where Landen's transformation goes back to am (tape/elliptic.h). */
static void
amplitude_ball(arb_t y, const arb_t u, const arb_t m, slong bits)
{
    enum { MOST = 40 };
    arb_ptr a = _arb_vec_init(3 * MOST), b = a + MOST, c = b + MOST;
    arb_t s, t;
    slong n = 0;

    arb_init(s);
    arb_init(t);
    arb_one(a);
    arb_sub(b, a, m, bits);
    arb_sqrt(b, b, bits);
    do {
        arb_add(a + n + 1, a + n, b + n, bits);
        arb_mul_2exp_si(a + n + 1, a + n + 1, -1);
        arb_mul(b + n + 1, a + n, b + n, bits);
        arb_sqrt(b + n + 1, b + n + 1, bits);
        arb_sub(c + n + 1, a + n, b + n, bits);
        arb_mul_2exp_si(c + n + 1, c + n + 1, -1);
        n++;
    } while (n + 1 < MOST && !arb_overlaps(a + n, b + n));
    arb_union(y, a + n, b + n, bits);
    arb_mul(y, y, u, bits);
    arb_mul_2exp_si(y, y, n);
    for (; n > 0; n--) {
        arb_sin_cos(s, t, y, bits);
        arb_mul(t, t, a + n, bits);
        arb_mul(t, t, t, bits);
        arb_mul(c + n, c + n, s, bits);
        arb_mul(s, s, b + n, bits);
        arb_addmul(t, s, s, bits);
        arb_sqrt(t, t, bits);
        arb_div(t, c + n, t, bits);
        arb_atan(t, t, bits);
        arb_add(y, y, t, bits);
        arb_mul_2exp_si(y, y, -1);
    }
    arb_clear(s);
    arb_clear(t);
    _arb_vec_clear(a, 3 * MOST);
}

/* y = dn = sqrt(cn^2 + (1 - m) sn^2) from y = am. */
static void
dn_of_amplitude(arb_t y, const arb_t m, slong bits)
{
    arb_t c, rest;

    arb_init(c);
    arb_init(rest);
    arb_sub_ui(rest, m, 1, bits);
    arb_sin_cos(y, c, y, bits);
    arb_mul(y, y, y, bits);
    arb_mul(y, y, rest, bits);
    arb_neg(y, y);
    arb_addmul(y, c, c, bits);
    arb_sqrt(y, y, bits);
    arb_clear(c);
    arb_clear(rest);
}

void
qdot_elliptic_ball(arb_t y, unsigned f, uint32_t n, const arb_struct *const *x, slong bits)
{
    const arb_struct *m = x[n - 1], *c = f == QDOT_ELLIPTIC_PI ? x[0] : NULL;
    const arb_struct *phi = n == (c != NULL ? 3 : 2) ? x[n - 2] : NULL;
    const bool jacobi = f == QDOT_JACOBI_AM || f == QDOT_JACOBI_DN;
    acb_ptr args, z; /* x and f(x) as complex numbers, which Arb's functions take */

    if (!stays_below_one(m, jacobi ? NULL : phi, jacobi || f == QDOT_ELLIPTIC_E, bits) || (c != NULL && !stays_below_one(c, phi, false, bits))) {
        arb_indeterminate(y);
        return;
    }
    if (jacobi) {
        if (arb_is_one(m)) {
            arb_sinh(y, x[0], bits);
            arb_atan(y, y, bits);
        } else {
            amplitude_ball(y, x[0], m, bits);
        }
        if (f == QDOT_JACOBI_DN)
            dn_of_amplitude(y, m, bits);
        return;
    }
    args = _acb_vec_init((slong)n + 1);
    z = args + n;
    for (uint32_t i = 0; i < n; i++)
        acb_set_arb(args + i, x[i]);
    if (f == QDOT_ELLIPTIC_K)
        acb_elliptic_k(z, args, bits);
    else if (f == QDOT_ELLIPTIC_F)
        acb_elliptic_f(z, args, args + 1, 0, bits);
    else if (f == QDOT_ELLIPTIC_E && phi == NULL)
        acb_elliptic_e(z, args, bits);
    else if (f == QDOT_ELLIPTIC_E)
        acb_elliptic_e_inc(z, args, args + 1, 0, bits);
    else if (phi == NULL)
        acb_elliptic_pi(z, args, args + 1, bits);
    else
        acb_elliptic_pi_inc(z, args, args + 1, args + 2, 0, bits);
    arb_set(y, acb_realref(z));
    _acb_vec_clear(args, (slong)n + 1);
}
