/* integral-value.c -- numbers of integrals: enclosed by Arb's integration, or by a double exponential substitution. */
#include "expr/integral-value.h"

#include "base/interrupt.h"
#include "expr/complex-ball.h"

enum { EVALUATIONS = 4000, AT_KINKS = 40000, LEVELS = 9, MOST_STEPS = 4096 };

static int
integrand(acb_ptr y, const acb_t z, void *user, slong order, slong bits)
{
    qdot_complex_ball_eval(user, y, z, order != 0, bits);
    return 0;
}

static bool
is_known_well(const arb_t y, slong bits)
{
    return arb_is_finite(y) && (arb_rel_accuracy_bits(y) >= bits || mag_cmp_2exp_si(arb_radref(y), -bits) < 0);
}

/* --- enclosed -------------------------------------------------------------------------------------- */

static bool
enclose(arb_t y, qdot_complex_ball *f, const arb_t a, const arb_t b, slong bits)
{
    acb_calc_integrate_opt_t options;
    acb_t lo, hi, sum;
    mag_t tolerance;
    bool known;

    acb_init(lo);
    acb_init(hi);
    acb_init(sum);
    mag_init(tolerance);
    acb_set_arb(lo, a);
    acb_set_arb(hi, b);
    mag_set_ui_2exp_si(tolerance, 1, -bits);
    acb_calc_integrate_opt_init(options);
    options->eval_limit = (f->kinked ? AT_KINKS : EVALUATIONS) + 20 * bits; /* each bit halves the piece with the kink */
    acb_calc_integrate(sum, integrand, f, lo, hi, bits, tolerance, options, bits + 20);
    known = acb_is_finite(sum) && arb_contains_zero(acb_imagref(sum)) && is_known_well(acb_realref(sum), bits / 2);
    arb_set(y, acb_realref(sum));
    acb_clear(lo);
    acb_clear(hi);
    acb_clear(sum);
    mag_clear(tolerance);
    return known;
}

/* --- by the double exponential substitution ------------------------------------------------------------ */

/* The integral from a to b as a sum over t: kind 0 finite, 1 from a, -1 to b, 2 over the whole line. */
typedef struct {
    qdot_complex_ball *f;
    const arb_struct *a, *b;
    int kind;
    slong bits; /* of the sum; the places are computed with three times as many */
} substitution;

/* y = f(x) dx/dt at t; false where it is not known. */
static bool
evaluate_substituted(const substitution *s, arb_t y, const arb_t t)
{
    const slong bits = 3 * s->bits + 64;
    arb_t u, du, g, h;
    acb_t x, v;
    bool known;

    arb_init(u);
    arb_init(du);
    arb_init(g);
    arb_init(h);
    acb_init(x);
    acb_init(v);
    arb_const_pi(g, bits);
    arb_mul_2exp_si(g, g, -1);
    arb_sinh_cosh(u, du, t, bits);
    arb_mul(u, u, g, bits);   /* pi/2 sinh t */
    arb_mul(du, du, g, bits); /* its derivative */
    if (s->kind == 0) {
        arb_sub(h, s->b, s->a, bits);
        arb_mul_2exp_si(u, u, 1);
        arb_neg(u, u);
        arb_exp(u, u, bits); /* x = a + (b - a)/(1 + e^(-2u)) */
        arb_add_ui(g, u, 1, bits);
        arb_div(g, h, g, bits);
        arb_add(acb_realref(x), s->a, g, bits);
        arb_mul(du, du, g, bits); /* dx/dt = (b - a) 2 u' e^(-2u)/(1 + e^(-2u))^2 */
        arb_mul_2exp_si(du, du, 1);
        arb_mul(du, du, u, bits);
        arb_add_ui(g, u, 1, bits);
        arb_div(du, du, g, bits);
    } else if (s->kind == 2) {
        arb_sinh_cosh(acb_realref(x), g, u, bits);
        arb_mul(du, du, g, bits);
    } else {
        arb_exp(g, u, bits);
        arb_mul(du, du, g, bits);
        if (s->kind > 0)
            arb_add(acb_realref(x), s->a, g, bits);
        else
            arb_sub(acb_realref(x), s->b, g, bits);
    }
    qdot_complex_ball_eval(s->f, v, x, false, bits);
    arb_mul(y, acb_realref(v), du, bits);
    known = acb_is_real(v) && arb_is_finite(y);
    arb_clear(u);
    arb_clear(du);
    arb_clear(g);
    arb_clear(h);
    acb_clear(x);
    acb_clear(v);
    return known;
}

/* Add to sum the terms at t = h (first + step k), k = 0, 1, ..., until they are negligible; false where they do not
 * become so. */
static bool
sum_outward(const substitution *s, arb_t sum, const arb_t h, long first, long step)
{
    arb_t t, term;
    mag_t size, least;
    int small = 0;
    bool lost = false;

    arb_init(t);
    arb_init(term);
    mag_init(size);
    mag_init(least);
    for (long k = 0; k < MOST_STEPS && small < 6; k++) {
        arb_mul_si(t, h, first + step * k, 3 * s->bits + 64);
        if (!evaluate_substituted(s, term, t)) { /* the place is not told from the end any more, or f is not defined */
            lost = true;
            break;
        }
        arb_add(sum, sum, term, 3 * s->bits);
        arb_get_mag(size, term);
        arb_get_mag(least, sum);
        mag_mul_2exp_si(least, least, -s->bits - 12);
        small = mag_cmp(size, least) <= 0 || mag_cmp_2exp_si(size, -4 * s->bits) < 0 ? small + 1 : 0;
    }
    arb_clear(t);
    arb_clear(term);
    mag_clear(size);
    mag_clear(least);
    return small >= 6 || (lost && small > 0);
}

/* Halve the step until two sums agree to the bits wanted; the radius of y is what they differ by. */
static bool
substitute(arb_t y, const substitution *s)
{
    arb_t h, sum, value, before, change;
    bool found = false, going = true;

    arb_init(h);
    arb_init(sum);
    arb_init(value);
    arb_init(before);
    arb_init(change);
    for (int level = 0; level < LEVELS && going && !found && !qdot_interrupt_flag; level++) {
        arb_one(h);
        arb_mul_2exp_si(h, h, -level - 1);
        going = level == 0 ? sum_outward(s, sum, h, 0, 1) && sum_outward(s, sum, h, -1, -1)
                           : sum_outward(s, sum, h, 1, 2) && sum_outward(s, sum, h, -1, -2);
        arb_mul(value, sum, h, 3 * s->bits);
        if (level > 1 && going) {
            arb_sub(change, value, before, 3 * s->bits);
            arb_abs(change, change);
            arb_mul_2exp_si(change, change, 1);
            arb_set(y, value);
            arb_add_error(y, change);
            found = is_known_well(y, s->bits - 4);
        }
        arb_set(before, value);
    }
    arb_clear(h);
    arb_clear(sum);
    arb_clear(value);
    arb_clear(before);
    arb_clear(change);
    return found;
}

qdot_status
qdot_integral_value(arb_t y, const qdot_pool *pool, qdot_expr f, const arb_t a, const arb_t b, slong bits, bool *proved)
{
    const bool from = arb_is_finite(a), to = arb_is_finite(b);
    qdot_complex_ball ball;
    bool found;

    *proved = true;
    QDOT_TRY(qdot_complex_ball_begin(&ball, pool, f));
    found = from && to && enclose(y, &ball, a, b, bits);
    if (!found) {
        const substitution s = {&ball, a, b, from && to ? 0 : from ? 1 : to ? -1 : 2, bits};

        *proved = false;
        found = substitute(y, &s);
    }
    if (!found)
        arb_indeterminate(y);
    qdot_complex_ball_end(&ball);
    return qdot_interrupt_check();
}
