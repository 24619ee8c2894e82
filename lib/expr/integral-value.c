/* integral-value.c -- numbers of integrals: enclosed by Arb's integration, or by a double exponential substitution. */
#include "expr/integral-value.h"

#include <math.h>

#include "base/interrupt.h"
#include "expr/complex-ball.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"

/* LEAST_REACH: the range of t that is looked through if it can be: distances from an end from 1e-7 to 7e6. */
enum { EVALUATIONS = 4000, AT_KINKS = 40000, LEVELS = 9, MOST_STEPS = 4096, MOST_PIECES = 8, LEAST_REACH = 3 };

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
    slong bits; /* of the sum; the places are computed with six times as many, to tell them from the ends */
    double from, to; /* the range of t in which the terms are not negligible; out */
} substitution;

/* y = f(x) dx/dt at t; false where it is not known. */
static bool
evaluate_substituted(const substitution *s, arb_t y, const arb_t t)
{
    const slong bits = 6 * s->bits + 64;
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
sum_outward(substitution *s, arb_t sum, const arb_t h, slong first, slong step)
{
    arb_t t, term;
    mag_t size, least;
    int small = 0;
    bool lost = false;

    arb_init(t);
    arb_init(term);
    mag_init(size);
    mag_init(least);
    for (slong k = 0; k < MOST_STEPS && small < 6; k++) {
        arb_mul_si(t, h, first + step * k, 6 * s->bits + 64);
        if (!evaluate_substituted(s, term, t)) { /* the place is not told from the end any more, or f is not defined */
            lost = true;
            break;
        }
        arb_add(sum, sum, term, 3 * s->bits);
        arb_get_mag(size, term);
        arb_get_mag(least, sum);
        mag_mul_2exp_si(least, least, -s->bits - 12);
        small = mag_cmp(size, least) <= 0 || mag_cmp_2exp_si(size, -4 * s->bits) < 0 ? small + 1 : 0;
        if (small == 0) {
            s->from = fmin(s->from, arf_get_d(arb_midref(t), ARF_RND_NEAR));
            s->to = fmax(s->to, arf_get_d(arb_midref(t), ARF_RND_NEAR));
        }
    }
    arb_clear(t);
    arb_clear(term);
    mag_clear(size);
    mag_clear(least);
    return small >= 6 || (lost && small > 0);
}

/* --- whether the sums saw all ----------------------------------------------------------------------------- */

/* f(x) dx over u, x = end + side e^u. */
typedef struct {
    qdot_complex_ball *f;
    const arb_struct *end;
    int side;
} distance;

static int
integrand_by_distance(acb_ptr y, const acb_t u, void *user, slong order, slong bits)
{
    const distance *d = user;
    acb_t x, e;

    acb_init(x);
    acb_init(e);
    acb_exp(e, u, bits);
    if (d->side < 0)
        acb_neg(x, e);
    else
        acb_set(x, e);
    acb_add_arb(x, x, d->end, bits);
    qdot_complex_ball_eval(d->f, y, x, order != 0, bits);
    acb_mul(y, y, e, bits);
    acb_clear(x);
    acb_clear(e);
    return 0;
}

/* Add to y the integral of f between the distances e^lo and e^hi from an end, enclosed. */
static bool
add_enclosed(arb_t y, const substitution *s, const arb_t end, int side, double lo, double hi, double farthest)
{
    distance d = {s->f, end, side};
    acb_calc_integrate_opt_t options;
    const slong bits = 6 * s->bits + 64;
    acb_t from, to, sum;
    mag_t tolerance;
    bool known;

    acb_init(from);
    acb_init(to);
    acb_init(sum);
    mag_init(tolerance);
    acb_set_d(from, lo);
    acb_set_d(to, hi);
    if (hi == farthest) { /* half of the range, exactly */
        arb_sub(acb_realref(to), s->b, s->a, bits);
        arb_mul_2exp_si(acb_realref(to), acb_realref(to), -1);
        arb_log(acb_realref(to), acb_realref(to), bits);
    }
    mag_set_ui_2exp_si(tolerance, 1, -s->bits);
    acb_calc_integrate_opt_init(options);
    options->eval_limit = AT_KINKS + 20 * s->bits;
    acb_calc_integrate(sum, integrand_by_distance, &d, from, to, s->bits + 20, tolerance, options, bits);
    known = acb_is_finite(sum) && arb_contains_zero(acb_imagref(sum)) && is_known_well(acb_realref(sum), s->bits / 2);
    arb_add(y, y, acb_realref(sum), bits);
    acb_clear(from);
    acb_clear(to);
    acb_clear(sum);
    mag_clear(tolerance);
    return known;
}

/* The integral over the range of t, enclosed. A peak between the places of the sums is in it. */
static bool
enclose_range(arb_t y, const substitution *s, double lo, double hi)
{
    const double pi = 3.141592653589793;
    double width;
    arf_t h;

    arb_zero(y);
    if (s->kind == 1 || s->kind == -1)
        return add_enclosed(y, s, s->kind > 0 ? s->a : s->b, s->kind, pi / 2 * sinh(lo), pi / 2 * sinh(hi), NAN);
    arf_init(h);
    arf_sub(h, arb_midref(s->b), arb_midref(s->a), 53, ARF_RND_NEAR);
    width = arf_get_d(h, ARF_RND_NEAR);
    arf_clear(h);
    return s->kind == 0 && add_enclosed(y, s, s->a, 1, log(width) + pi * sinh(lo), log(width / 2), log(width / 2)) &&
           add_enclosed(y, s, s->b, -1, log(width) - pi * sinh(hi), log(width / 2), log(width / 2));
}

/* Whether y is what the enclosure of the range gives; if it differs, y is replaced by that. False: it is not known. */
static bool
see_all(arb_t y, const substitution *s)
{
    arb_t all, change;
    mag_t size;
    bool known;

    arb_init(all);
    arb_init(change);
    mag_init(size);
    known = enclose_range(all, s, fmin(s->from, -LEAST_REACH), fmax(s->to, LEAST_REACH)) || enclose_range(all, s, s->from, s->to);
    if (known) {
        arb_sub(change, all, y, 3 * s->bits);
        arb_get_mag(size, all);
        mag_mul_2exp_si(size, size, 6 - s->bits); /* of what lies beyond the range */
        arb_add_error_mag(change, size);
        if (!arb_contains_zero(change)) {
            arb_set(y, all);
            arb_add_error_mag(y, size);
        }
    }
    arb_clear(all);
    arb_clear(change);
    mag_clear(size);
    return known;
}

/* Halve the step until two sums agree to the bits wanted; the radius of y is what they differ by. */
static bool
substitute(arb_t y, substitution *s)
{
    arb_t h, sum, value, before, change;
    bool found = false, going = true;

    arb_init(h);
    arb_init(sum);
    arb_init(value);
    arb_init(before);
    arb_init(change);
    for (int level = 0; level < LEVELS && going && !found && !qdot_interrupt_is_set(); level++) {
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
    return found && see_all(y, s);
}

/* --- on pieces ------------------------------------------------------------------------------------------ */

static bool
substitute_between(arb_t y, qdot_complex_ball *f, const arb_t a, const arb_t b, slong bits)
{
    const bool from = arb_is_finite(a), to = arb_is_finite(b);

    return substitute(y, &(substitution){f, a, b, from && to ? 0 : from ? 1 : to ? -1 : 2, bits, 0, 0});
}

/* From a to b in two parts that are not alike: over the whole, poles that lie symmetrically cancel in the sums, and an
 * integral that diverges has a number, as that of tan(x) from 0 to 2 pi or of x/(x^2 + 1) over the whole line. */
static bool
estimate(arb_t y, qdot_complex_ball *f, const arb_t a, const arb_t b, slong bits)
{
    const bool from = arb_is_finite(a), to = arb_is_finite(b);
    const slong precise = 8 * bits + 64;
    arb_t middle, width, part;
    bool found;

    arb_init(middle);
    arb_init(width);
    arb_init(part);
    arb_const_pi(middle, precise);
    arb_mul_2exp_si(middle, middle, -3); /* of the width: no zero of usual functions is there */
    if (from && to) {
        arb_sub(width, b, a, precise);
        arb_mul(middle, middle, width, precise);
    }
    if (from)
        arb_add(middle, a, middle, precise);
    else if (to)
        arb_sub(middle, b, middle, precise);
    found = substitute_between(y, f, a, middle, bits) && substitute_between(part, f, middle, b, bits);
    arb_add(y, y, part, 3 * bits);
    arb_clear(middle);
    arb_clear(width);
    arb_clear(part);
    return found;
}

/* From a to b by the first way that gives a number. */
static bool
integrate_piece(arb_t y, qdot_complex_ball *f, const arb_t a, const arb_t b, slong bits, bool *proved)
{
    if (arb_is_finite(a) && arb_is_finite(b) && enclose(y, f, a, b, bits))
        return true;
    *proved = false;
    return estimate(y, f, a, b, bits);
}

/* Whether the node e is where u, linear in the variable, may make the integrand singular: abs(u), log(u), u^p. */
static qdot_expr
base_of_singularity(const qdot_pool *pool, qdot_expr e, uint32_t k)
{
    const qdot_node *node = qdot_expr_node(pool, e);
    int64_t whole;

    if (node->kind == QDOT_FUN && k == 0 && (node->op == QDOT_ABS || node->op == QDOT_LOG || node->op == QDOT_SIGN))
        return qdot_expr_arg(pool, e, 0);
    if (node->kind == QDOT_PROD && k % 2 == 1 && !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, k + 1), &whole))
        return qdot_expr_arg(pool, e, k);
    return QDOT_NIL;
}

/* The place x = -c/d at which u = c + d x vanishes, in c + d x of rationals. */
static bool
find_zero(const qdot_pool *pool, qdot_expr u, fmpq_t place)
{
    if (qdot_bound_number(pool, u) == 1) {
        fmpq_zero(place);
        return true;
    }
    if (qdot_expr_kind(pool, u) != QDOT_SUM || qdot_expr_count(pool, u) != 3 ||
        qdot_bound_number(pool, qdot_expr_arg(pool, u, 1)) != 1)
        return false;
    fmpq_div(place, qdot_expr_rational(pool, qdot_expr_arg(pool, u, 0)), qdot_expr_rational(pool, qdot_expr_arg(pool, u, 2)));
    fmpq_neg(place, place);
    return true;
}

/* The least such place between a and b, *at. */
static bool
find_split(const qdot_complex_ball *f, const arb_t a, const arb_t b, arb_t at, slong bits)
{
    bool found = false;
    fmpq_t place;
    arb_t x;

    fmpq_init(place);
    arb_init(x);
    for (size_t i = 0; i < f->walk.n; i++)
        for (uint32_t k = 0; k < qdot_expr_count(f->pool, f->walk.at[i]); k++) {
            const qdot_expr u = base_of_singularity(f->pool, f->walk.at[i], k);

            if (u == QDOT_NIL || !find_zero(f->pool, u, place))
                continue;
            arb_set_fmpq(x, place, 4 * bits + 64);
            if (!arb_gt(x, a) || !arb_lt(x, b) || (found && !arb_lt(x, at)))
                continue;
            arb_set(at, x);
            found = true;
        }
    fmpq_clear(place);
    arb_clear(x);
    return found;
}

/* From a to b: on the pieces between the places at which f may be singular, where f has kinks or steps or cannot be
 * integrated as a whole. */
static bool
integrate_split(arb_t y, qdot_complex_ball *f, const arb_t a, const arb_t b, slong bits, bool *proved)
{
    arb_t from, at, part;
    bool last, found;

    arb_init(from);
    arb_init(at);
    arb_init(part);
    last = !find_split(f, a, b, at, bits);
    found = (last || !f->kinked) && integrate_piece(y, f, a, b, bits, proved);
    if (!found && !last) {
        arb_set(from, a);
        arb_zero(y);
        for (int pieces = 0; pieces < MOST_PIECES && !last; pieces++) {
            last = !find_split(f, from, b, at, bits);
            found = integrate_piece(part, f, from, last ? b : at, bits, proved);
            arb_add(y, y, part, 3 * bits);
            if (!found)
                break;
            arb_set(from, at);
        }
        found = found && last;
    }
    arb_clear(from);
    arb_clear(at);
    arb_clear(part);
    return found;
}

qdot_status
qdot_integral_value(arb_t y, const qdot_pool *pool, qdot_expr f, const arb_t a, const arb_t b, slong bits, bool *proved)
{
    qdot_complex_ball ball;

    *proved = true;
    QDOT_TRY(qdot_complex_ball_begin(&ball, pool, f));
    if (!integrate_split(y, &ball, a, b, bits, proved))
        arb_indeterminate(y);
    qdot_complex_ball_end(&ball);
    return qdot_interrupt_check();
}
