/* elliptic-ball.c -- Legendre's elliptic integrals in ball (interval) arithmetic. */
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

void
qdot_elliptic_ball(arb_t y, unsigned f, uint32_t n, const arb_struct *const *x, slong bits)
{
    const arb_struct *m = x[n - 1], *c = f == QDOT_ELLIPTIC_PI ? x[0] : NULL;
    const arb_struct *phi = n == (c != NULL ? 3 : 2) ? x[n - 2] : NULL;
    acb_ptr args, z; /* x and f(x) as complex numbers, which Arb's functions take */

    if (!stays_below_one(m, phi, f == QDOT_ELLIPTIC_E, bits) || (c != NULL && !stays_below_one(c, phi, false, bits))) {
        arb_indeterminate(y);
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
