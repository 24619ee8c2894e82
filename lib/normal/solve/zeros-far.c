/* zeros-far.c -- proves that an equation has no zeros beyond some x, by comparing the growth of its terms. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/solve/zeros-parts.h"

/* Exponents are stored as integer multiples of 1/UNIT, so that their sums are exact. */
enum { UNIT = 5040, LARGEST = 10000, TERMS = 4, FIRST = 2, LAST = 30, SIZE = 400 };

/* A scale S(x) = x^power log(x)^logs exp(sum of rate x^exponent), the exponents descending and > 0. */
typedef struct {
    int64_t power, logs;
    size_t n;
    struct {
        int64_t exponent;
        qdot_expr rate; /* a constant, not 0 */
        qdot_interval bounds;
    } term[TERMS];
} far_scale;

/* A function that is m S(x), m in bounds, for all x >= R. Where it grows faster than every S, as exp(exp(x)) and x^x do, the
 * bounds reach to infinity on the side of its sign and do not hold 0. */
typedef struct {
    qdot_interval bounds;
    far_scale scale;
    bool known;
    bool nowhere; /* the function is defined at no x >= R, the start of the range */
} far_form;

typedef struct {
    qdot_pool *pool;
    qdot_expr x; /* the variable, positive */
    double R;
    qdot_walk *walk;
    far_form *form; /* [walk->n] growth of each node */
} far_task;

static const far_form form_unknown = {.bounds = {-INFINITY, INFINITY}};
static const far_form form_nowhere = {.bounds = {-INFINITY, INFINITY}, .nowhere = true};

/* --- scales: functions S(x) that measure growth ---------------------------------------------------- */

/* Multiply the scale s by exp(rate x^exponent). */
static bool
scale_add_term(qdot_pool *pool, far_scale *s, int64_t exponent, qdot_expr rate)
{
    size_t k = 0;

    while (k < s->n && s->term[k].exponent > exponent)
        k++;
    if (k < s->n && s->term[k].exponent == exponent) {
        rate = qdot_add(pool, s->term[k].rate, rate);
        s->n--;
        memmove(&s->term[k], &s->term[k + 1], (s->n - k) * sizeof *s->term);
    }
    if (rate == QDOT_ZERO)
        return true;
    if (rate == QDOT_NIL || s->n == TERMS)
        return false;
    memmove(&s->term[k + 1], &s->term[k], (s->n - k) * sizeof *s->term);
    s->term[k].exponent = exponent;
    s->term[k].rate = rate;
    s->term[k].bounds = qdot_ball_bounds(pool, rate);
    s->n++;
    return s->term[k].bounds.lo > 0 || s->term[k].bounds.hi < 0;
}

/* Multiply the scale s by r to the power num / den. */
static bool
scale_multiply(qdot_pool *pool, far_scale *s, const far_scale *r, int64_t num, int64_t den)
{
    if ((r->power * num) % den != 0 || (r->logs * num) % den != 0 ||
        llabs(r->power) > LARGEST * (int64_t)UNIT || llabs(r->logs) > LARGEST * (int64_t)UNIT)
        return false;
    s->power += r->power * num / den;
    s->logs += r->logs * num / den;
    for (size_t k = 0; k < r->n; k++)
        if (!scale_add_term(
                pool, s, r->term[k].exponent,
                qdot_mul(pool, qdot_expr_ratio(pool, num, den), r->term[k].rate)))
            return false;
    return true;
}

/* How the scale S(x) grows for large x: > 0 to infinity, < 0 to 0; 0: S = 1. */
static int
scale_growth(const far_scale *s)
{
    int64_t leading = s->power != 0 ? s->power : s->logs;

    if (s->n > 0)
        return s->term[0].bounds.lo > 0 ? 1 : -1;
    return leading > 0 ? 1 : leading < 0 ? -1 : 0;
}

static qdot_interval
power_of_R(const far_task *t, int64_t exponent)
{
    double e = (double)exponent / UNIT;

    return qdot_interval_power(qdot_interval_point(t->R), qdot_interval_outward(e, e));
}

/* A bound of S for x >= R, of an S that falls to 0: S(R) if S falls all the way, infinity if that is not seen.
 *
 *     x S'/S = sum exponent rate x^exponent + power + logs/log x <= 0
 *
 * holds for x >= R if it does at R with the leading term and what is positive of the others: these,
 * divided by x^exponent of the leading one, fall. */
static double
bound_of_scale(const far_task *t, const far_scale *s)
{
    qdot_interval slope = {0, 0}, size = {0, 0}, R = qdot_interval_point(t->R), log_R;
    double rest = fmax((double)s->power, 0) + fmax((double)s->logs, 0);

    log_R = qdot_interval_rising(log, R); /* log R is > 1 */
    for (size_t k = 0; k < s->n; k++) {
        double e = (double)s->term[k].exponent / UNIT;
        qdot_interval rate = s->term[k].bounds, at = power_of_R(t, s->term[k].exponent);

        size = qdot_interval_sum(size, qdot_interval_product(rate, at, false));
        if (k == 0 || rate.hi > 0)
            slope = qdot_interval_sum(
                slope,
                qdot_interval_product(
                    qdot_interval_product(rate, qdot_interval_outward(e, e), false), at,
                    false));
    }
    if (s->n > 0)
        slope = qdot_interval_sum(slope, qdot_interval_point(rest / UNIT));
    else if (s->power != 0)
        slope = qdot_interval_sum(
            qdot_interval_point((double)s->power),
            qdot_interval_quotient(qdot_interval_point(fmax((double)s->logs, 0)), log_R));
    if (!(slope.hi <= 0))
        return INFINITY;
    size = qdot_interval_sum(
        size, qdot_interval_product(
                  qdot_interval_outward((double)s->power / UNIT, (double)s->power / UNIT),
                  log_R, false));
    size = qdot_interval_sum(
        size, qdot_interval_product(
                  qdot_interval_outward((double)s->logs / UNIT, (double)s->logs / UNIT),
                  qdot_interval_rising(log, log_R), false));
    return qdot_interval_rising(exp, size).hi;
}

/* Bounds of the scale S(x) for x >= R. */
static qdot_interval
range_of_scale(const far_task *t, const far_scale *s)
{
    far_scale inverse = {0};

    switch (scale_growth(s)) {
    case 0: return qdot_interval_point(1);
    case -1: return (qdot_interval){0, bound_of_scale(t, s)};
    default:
        if (!scale_multiply(t->pool, &inverse, s, -1, 1))
            return (qdot_interval){0, INFINITY};
        return (qdot_interval){qdot_interval_outward(1 / bound_of_scale(t, &inverse), 1).lo,
                               INFINITY};
    }
}

/* --- forms: a scale times a bounded factor --------------------------------------------------------- */

static const far_form *
growth_of_node(const far_task *t, qdot_expr e)
{
    return &t->form[qdot_walk_index(t->walk, e)];
}

static far_form
growth_of_constant(qdot_interval c)
{
    return (far_form){.bounds = c, .known = isfinite(c.lo) && isfinite(c.hi)};
}

static bool
has_finite_bounds(const far_form *f)
{
    return isfinite(f->bounds.lo) && isfinite(f->bounds.hi);
}

static far_form
check_growth(far_form f)
{
    f.known = f.known && (has_finite_bounds(&f) || (f.bounds.lo > 0 && isfinite(f.bounds.lo)) ||
                          (f.bounds.hi < 0 && isfinite(f.bounds.hi)));
    return f;
}

static qdot_interval
range_of_growth(const far_task *t, const far_form *f)
{
    return has_finite_bounds(f) ? qdot_interval_product(f->bounds, range_of_scale(t, &f->scale), false) : qdot_interval_whole;
}

static far_form
multiply_growth(const far_task *t, far_form f, const far_form *g)
{
    const bool bounded = has_finite_bounds(&f) && has_finite_bounds(g);

    f.known = f.known && g->known && scale_multiply(t->pool, &f.scale, &g->scale, 1, 1);
    if (!bounded && (!(f.bounds.lo > 0 || f.bounds.hi < 0) || !(g->bounds.lo > 0 || g->bounds.hi < 0)))
        return form_unknown;
    f.bounds = qdot_interval_product(f.bounds, g->bounds, false);
    return check_growth(f);
}

static far_form
growth_of_power(const far_task *t, const far_form *f, const fmpq *exponent)
{
    far_form g = {.known = f->known};
    int64_t num, den;

    if (!f->known || fmpz_cmp_si(fmpq_denref(exponent), UNIT) > 0 ||
        fmpz_cmp_si(fmpq_numref(exponent), LARGEST) > 0 ||
        fmpz_cmp_si(fmpq_numref(exponent), -LARGEST) < 0)
        return form_unknown;
    num = fmpz_get_si(fmpq_numref(exponent));
    den = fmpz_get_si(fmpq_denref(exponent));
    if (den > 1 && f->bounds.hi < 0)
        return form_nowhere;
    if ((num < 0 && f->bounds.lo <= 0 && f->bounds.hi >= 0) ||
        (den > 1 && (f->bounds.lo < 0 || (num < 0 && f->bounds.lo == 0))))
        return form_unknown;
    g.bounds = qdot_interval_power(
        f->bounds, den == 1 ? qdot_interval_point((double)num)
                            : qdot_interval_outward((double)num / (double)den,
                                                    (double)num / (double)den));
    g.known = scale_multiply(t->pool, &g.scale, &f->scale, num, den);
    return check_growth(g);
}

/* The growth of f + g: the term that grows less is written as a bounded factor times the other one. */
static far_form
add_growth(const far_task *t, const far_form *f, const far_form *g)
{
    far_scale ratio = g->scale;
    far_form sum = *f;
    qdot_interval other = g->bounds;
    int growth;

    if (!f->known || !g->known || !scale_multiply(t->pool, &ratio, &f->scale, -1, 1))
        return form_unknown;
    growth = scale_growth(&ratio);
    if (growth > 0)
        return add_growth(t, g, f);
    if (growth < 0 && !has_finite_bounds(g)) /* g may exceed its scale: only the sign of g over the scale of f is known */
        other = other.lo > 0 ? (qdot_interval){0, INFINITY} : (qdot_interval){-INFINITY, 0};
    else if (growth < 0)
        other = qdot_interval_product(other, range_of_scale(t, &ratio), false);
    sum.bounds = qdot_interval_sum(f->bounds, other);
    return check_growth(sum);
}

/* --- exponentials and logarithms of forms ---------------------------------------------------------- */

/* Whether e is K x^p with a constant K and p > 0; then *rate is K, and *exponent is p in multiples of 1/UNIT. */
static bool
is_power_of_x(const far_task *t, qdot_expr e, qdot_expr *rate, int64_t *exponent)
{
    qdot_pool *pool = t->pool;
    const qdot_expr x = t->x;

    *rate = QDOT_ONE;
    *exponent = UNIT;
    if (e == x)
        return true;
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    *rate = qdot_expr_arg(pool, e, 0);
    *exponent = 0;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1),
                  scaled;

        if (base != x) {
            *rate = qdot_mul(pool, *rate, qdot_pow(pool, base, p));
            continue;
        }
        scaled = qdot_mul(pool, p, qdot_expr_int(pool, UNIT));
        if (!qdot_expr_to_int(pool, scaled, exponent))
            return false;
    }
    return *rate != QDOT_NIL && !qdot_expr_contains(pool, *rate, x) && *exponent > 0;
}

/* The growth of exp(u) for u of one sign with |u| >= c x: at least that of exp(c x), or at most that of exp(-c x). */
static far_form
growth_of_fast_exponential(const far_task *t, const far_form *u)
{
    const far_scale x = {.power = UNIT};
    far_scale slower = {0};
    const double least = u->bounds.lo > 0 ? u->bounds.lo : -u->bounds.hi;
    double most, rate;
    far_form f = {.known = true};

    if (!u->known || !(least > 0) || !scale_multiply(t->pool, &slower, &x, 1, 1) ||
        !scale_multiply(t->pool, &slower, &u->scale, -1, 1) || scale_growth(&slower) > 0)
        return form_unknown;
    most = scale_growth(&slower) == 0 ? 1 : bound_of_scale(t, &slower); /* bound of x/S(x), S the scale by which u grows */
    rate = least / most * (1 - 1e-9);
    if (!(rate > 0))
        return form_unknown;
    rate = fmin(rate, 1e6);
    f.bounds = u->bounds.lo > 0 ? (qdot_interval){1, INFINITY} : (qdot_interval){0, 1};
    f.known = scale_add_term(t->pool, &f.scale, UNIT,
                             qdot_expr_of_double(t->pool, u->bounds.lo > 0 ? rate : -rate));
    return check_growth(f);
}

/* The growth of exp(by u) for a constant `by`, as a product over the terms of the sum u. */
static far_form
growth_of_exponential_by_terms(const far_task *t, qdot_expr u, qdot_expr by)
{
    qdot_pool *pool = t->pool;
    bool sum = qdot_expr_kind(pool, u) == QDOT_SUM;
    uint32_t n = sum ? qdot_expr_count(pool, u) : 1;
    qdot_interval rest =
        sum ? qdot_ball_bounds(pool, qdot_mul(pool, by, qdot_expr_arg(pool, u, 0)))
            : qdot_interval_point(0);
    far_form f = {.known = true};

    for (uint32_t i = sum ? 1 : 0; i < n && f.known; i += 2) {
        qdot_expr c = sum ? qdot_mul(pool, by, qdot_expr_arg(pool, u, i + 1)) : by,
                  e = sum ? qdot_expr_arg(pool, u, i) : u, rate;
        int64_t exponent;
        const far_form *part = growth_of_node(t, e);

        if (is_power_of_x(t, e, &rate, &exponent))
            f.known = scale_add_term(pool, &f.scale, exponent, qdot_mul(pool, c, rate));
        else if (part->known && scale_growth(&part->scale) <= 0)
            rest = qdot_interval_sum(rest,
                                     qdot_interval_product(qdot_ball_bounds(pool, c),
                                                           range_of_growth(t, part), false));
        else
            f.known = false;
    }
    f.bounds = qdot_interval_rising(exp, rest);
    f.bounds.lo = fmax(f.bounds.lo, 0);
    return check_growth(f);
}

/* The growth of exp(by u) for a constant `by`. */
static far_form
growth_of_exponential(const far_task *t, qdot_expr u, qdot_expr by)
{
    const far_form f = growth_of_exponential_by_terms(t, u, by), factor = growth_of_constant(qdot_ball_bounds(t->pool, by));
    far_form all;

    if (f.known)
        return f;
    all = multiply_growth(t, *growth_of_node(t, u), &factor);
    return growth_of_fast_exponential(t, &all);
}

/* The growth of log u for u = m S(x), which is log m + power log x + sum of rate x^exponent. */
static far_form
growth_of_logarithm(const far_task *t, const far_form *u)
{
    far_form sum, log_x = {.known = true, .scale = {.logs = UNIT}};
    double power = (double)u->scale.power / UNIT;

    if (u->known && u->bounds.hi < 0)
        return form_nowhere;
    if (!u->known || !(u->bounds.lo > 0) || u->scale.logs != 0)
        return form_unknown;
    sum = growth_of_constant(qdot_interval_rising(log, u->bounds));
    log_x.bounds = qdot_interval_outward(power, power);
    if (u->scale.power != 0)
        sum = add_growth(t, &log_x, &sum);
    for (size_t k = 0; k < u->scale.n; k++) {
        far_form term = {.known = true,
                         .bounds = u->scale.term[k].bounds,
                         .scale = {.power = u->scale.term[k].exponent}};

        sum = add_growth(t, &sum, &term);
    }
    return sum;
}

/* --- forms of other functions ---------------------------------------------------------------------- */

/* Bounds of h(v)/v for 0 < |v| <= most, where h is an odd function; infinite if unknown. */
static qdot_interval
bounds_of_quotient(qdot_fun_id h, double most)
{
    double square = most * most;

    if (!(most < 0.5))
        return qdot_interval_whole;
    switch (h) { /* the error of the Taylor series is its next term, enlarged to cover the terms after it */
    case QDOT_SIN:
    case QDOT_ASINH: return (qdot_interval){1 - 0.17 * square, 1};
    case QDOT_TANH:
    case QDOT_ATAN: return (qdot_interval){1 - 0.34 * square, 1};
    case QDOT_SINH:
    case QDOT_ASIN: return (qdot_interval){1, 1 + 0.25 * square};
    case QDOT_TAN:
    case QDOT_ATANH: return (qdot_interval){1, 1 + 0.5 * square};
    default: return qdot_interval_whole;
    }
}

static far_form
growth_of_function(const far_task *t, qdot_expr e)
{
    qdot_fun_id h = qdot_expr_node(t->pool, e)->op;
    qdot_expr arg = qdot_expr_arg(t->pool, e, 0);
    const far_form *u = growth_of_node(t, arg);
    qdot_interval v, quotient;
    far_form f = *u;

    if (h == QDOT_SIN || h == QDOT_COS)
        f = growth_of_constant((qdot_interval){-1, 1});
    if (qdot_expr_count(t->pool, e) != 1 || !u->known)
        return h == QDOT_SIN || h == QDOT_COS ? f : form_unknown;
    if (h == QDOT_EXP)
        return growth_of_exponential(t, arg, QDOT_ONE);
    if (h == QDOT_LOG)
        return growth_of_logarithm(t, u);
    v = range_of_growth(t, u);
    quotient = bounds_of_quotient(h, qdot_interval_size(v).hi);
    if (scale_growth(&u->scale) < 0 && isfinite(quotient.lo)) {
        f = *u;
        f.bounds = qdot_interval_product(u->bounds, quotient, false);
        return check_growth(f);
    }
    if ((h == QDOT_ASIN || h == QDOT_ACOS || h == QDOT_ATANH) && (v.lo > 1 || v.hi < -1))
        return form_nowhere;
    if (h == QDOT_ACOSH && v.hi < 1)
        return form_nowhere;
    switch (h) {
    case QDOT_SIN:
        return v.hi - v.lo < 1 ? growth_of_constant(qdot_interval_wave(sin, v, M_PI / 2)) : f;
    case QDOT_COS:
        return v.hi - v.lo < 1 ? growth_of_constant(qdot_interval_wave(cos, v, 0)) : f;
    case QDOT_TANH: return growth_of_constant(qdot_interval_rising(tanh, v));
    case QDOT_ATAN: return growth_of_constant(qdot_interval_rising(atan, v));
    case QDOT_ERF: return growth_of_constant(qdot_interval_rising(erf, v));
    case QDOT_ABS: f.bounds = qdot_interval_size(f.bounds); return f;
    case QDOT_SIGN:
        return u->bounds.lo > 0   ? growth_of_constant(qdot_interval_point(1))
               : u->bounds.hi < 0 ? growth_of_constant(qdot_interval_point(-1))
                                  : form_unknown;
    default: return form_unknown;
    }
}

/* The growth of base^exponent = exp(exponent log base), if both the base and the exponent contain x. */
static far_form
growth_of_general_power(const far_task *t, const far_form *base, const far_form *exponent)
{
    const far_form log_base = growth_of_logarithm(t, base);
    far_form u;

    if (log_base.nowhere || !log_base.known || !exponent->known)
        return log_base.nowhere ? form_nowhere : form_unknown;
    u = multiply_growth(t, *exponent, &log_base);
    if (u.known && has_finite_bounds(&u) && scale_growth(&u.scale) <= 0)
        return check_growth(
            (far_form){.known = true, .bounds = qdot_interval_within(
                                          qdot_interval_rising(exp, range_of_growth(t, &u)), 0, INFINITY)});
    return growth_of_fast_exponential(t, &u);
}

static far_form
growth_of_product(const far_task *t, qdot_expr e)
{
    qdot_pool *pool = t->pool;
    far_form f = growth_of_constant(qdot_ball_bounds(pool, qdot_expr_arg(pool, e, 0)));

    for (uint32_t i = 1; i < qdot_expr_count(pool, e) && f.known; i += 2) {
        qdot_expr base = qdot_expr_arg(pool, e, i),
                  exponent = qdot_expr_arg(pool, e, i + 1);
        const fmpq *rational = qdot_expr_rational(pool, exponent);
        far_form factor;

        if (rational != NULL)
            factor = growth_of_power(t, growth_of_node(t, base), rational);
        else if (qdot_expr_contains(pool, base, t->x))
            factor = growth_of_general_power(t, growth_of_node(t, base), growth_of_node(t, exponent));
        else if (!(qdot_ball_bounds(pool, base).lo > 0))
            factor = form_unknown;
        else
            factor = growth_of_exponential(t, exponent, qdot_fun1(pool, QDOT_LOG, base));
        f = multiply_growth(t, f, &factor);
    }
    return f;
}

static far_form
growth_of_sum(const far_task *t, qdot_expr e)
{
    qdot_pool *pool = t->pool;
    far_form f = growth_of_constant(qdot_ball_bounds(pool, qdot_expr_arg(pool, e, 0)));
    bool any = qdot_expr_arg(pool, e, 0) != QDOT_ZERO;

    for (uint32_t i = 1; i < qdot_expr_count(pool, e) && f.known; i += 2) {
        far_form term =
            growth_of_constant(qdot_ball_bounds(pool, qdot_expr_arg(pool, e, i + 1)));

        term = multiply_growth(t, term, growth_of_node(t, qdot_expr_arg(pool, e, i)));
        f = any ? add_growth(t, &f, &term) : term;
        any = true;
    }
    return f;
}

/* Whether an operand of e is undefined for all large x; the branches of if(...) are not considered. */
static bool
is_undefined_far_out(const far_task *t, qdot_expr e)
{
    bool choice = qdot_expr_kind(t->pool, e) == QDOT_FUN &&
                  qdot_expr_node(t->pool, e)->op == QDOT_IF;
    uint32_t n = choice || e == t->x ? 0 : qdot_expr_count(t->pool, e);

    for (uint32_t i = 0; i < n; i++)
        if (growth_of_node(t, qdot_expr_arg(t->pool, e, i))->nowhere)
            return true;
    return false;
}

static far_form
find_growth_of_node(const far_task *t, qdot_expr e)
{
    if (is_undefined_far_out(t, e))
        return form_nowhere;
    if (!qdot_expr_contains(t->pool, e, t->x))
        return qdot_expr_is_scalar(t->pool, e)
                   ? growth_of_constant(qdot_ball_bounds(t->pool, e))
                   : form_unknown;
    if (e == t->x)
        return (far_form){.bounds = {1, 1}, .scale = {.power = UNIT}, .known = true};
    switch (qdot_expr_kind(t->pool, e)) {
    case QDOT_SUM: return growth_of_sum(t, e);
    case QDOT_PROD: return growth_of_product(t, e);
    case QDOT_FUN: return growth_of_function(t, e);
    default: return form_unknown;
    }
}

/* --- whether there are zeros far away -------------------------------------------------------------- */

/* The functions sinh and cosh written as exponentials, and exp(u) with u expanded. */
static qdot_expr
write_as_exponentials(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_fun_id h = qdot_expr_node(pool, e)->op;
    qdot_expr u, up, down;

    (void)user;
    if (h != QDOT_EXP && h != QDOT_SINH && h != QDOT_COSH)
        return e;
    u = qdot_expand(pool, qdot_expr_arg(pool, e, 0));
    up = qdot_fun1(pool, QDOT_EXP, u);
    if (h == QDOT_EXP)
        return up;
    down = qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, u));
    return qdot_mul(pool, QDOT_HALF,
                    h == QDOT_COSH ? qdot_add(pool, up, down) : qdot_sub(pool, up, down));
}

qdot_status
qdot_zeros_far(qdot_pool *pool, qdot_expr f, qdot_expr x, int sign, double *R)
{
    qdot_expr far = qdot_symbol_get(pool, QDOT_FORMAL, "far#x"), to;
    far_task t = {.pool = pool, .x = far};
    qdot_status status;
    qdot_walk w;

    *R = INFINITY;
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_symbol(pool, far)->lo == QDOT_NIL)
        qdot_symbol_domain(pool, far, QDOT_ZERO, true, QDOT_NIL, false);
    to = qdot_mul(pool, qdot_expr_int(pool, sign), far);
    f = qdot_walk_replace(pool, qdot_subs(pool, f, 1, &x, &to), QDOT_FUN, write_as_exponentials,
                          NULL);
    status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN) { /* undefined for all large x */
        *R = 1;
        return QDOT_OK;
    }
    QDOT_TRY(status);
    if (qdot_expr_size(pool, f) > SIZE)
        return QDOT_OK;
    QDOT_TRY(qdot_walk_begin(pool, f, &w));
    t.walk = &w;
    t.form = qdot_calloc(w.n, sizeof *t.form);
    status = t.form == NULL ? QDOT_ENOMEM : QDOT_OK;
    for (int k = FIRST; k <= LAST && isinf(*R) && status == QDOT_OK; k++) {
        const far_form *last = &t.form[w.n - 1];

        t.R = ldexp(1, k);
        for (size_t i = 0; i < w.n; i++)
            t.form[i] = find_growth_of_node(&t, w.at[i]);
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN)
            status = QDOT_OK;
        else if (last->nowhere ||
                 (last->known && (last->bounds.lo > 0 || last->bounds.hi < 0)))
            *R = t.R;
    }
    qdot_free(t.form);
    qdot_walk_end(&w);
    return status;
}
