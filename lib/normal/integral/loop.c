/* loop.c -- loop integrals: substitutions that make the square rational, and its division into Q H^2. */
#include "normal/integral/loop.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/budget.h"
#include "normal/inequality/inequality.h"
#include "normal/inequality/sign.h"
#include "normal/integral/loop-parts.h"
#include "normal/integral/methods.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { EFFORT = 20000 };
#define CONSTRUCTIONS 4000000

int
qdot_loop_sign(qdot_loop_task *l, qdot_expr e)
{
    int sign = 0;

    e = qdot_integral_normal(&l->t, e);
    return e != QDOT_NIL && qdot_sign(l->pool, e, l->facts, &sign) == QDOT_OK ? sign : 0;
}

/* --- f (dx/du)^2 = Q H^2 ------------------------------------------------------------------- */

/* Multiply Q H^2 by base^power, power of either sign: H by base^half, half = power/2 rounded down, and Q by the base that an
 * odd power leaves. */
static bool
take_factor(qdot_loop_task *l, qdot_loop_square *s, qdot_expr base, int64_t power, qdot_expr u)
{
    const qdot_poly p = qdot_poly_read(&l->t, base, u);
    const int64_t half = power >= 0 ? power / 2 : (power - 1) / 2;
    qdot_poly raised;

    if (p.degree < 1)
        return false;
    if (power % 2 != 0)
        s->Q = qdot_poly_mul(&l->t, &s->Q, &p);
    if (half > 0) {
        raised = qdot_poly_power(&l->t, &p, half);
        s->over = qdot_poly_mul(&l->t, &s->over, &raised);
    } else if (half < 0) {
        s->base[s->n] = p;
        s->power[s->n++] = -half;
    }
    return true;
}

/* The coefficient of the highest power of u in the product of the factors of a reading. */
static qdot_expr
leading(qdot_loop_task *l, const qdot_reading *r, qdot_expr u)
{
    qdot_expr c = QDOT_ONE;

    for (int i = 0; i < r->factors; i++) {
        const qdot_poly p = qdot_poly_read(&l->t, r->factor[i].base, u);

        c = qdot_mul(l->pool, c, qdot_pow_int(l->pool, qdot_poly_coefficient(&p, p.degree), r->factor[i].power));
    }
    return c;
}

/* Write g, rational in u, as Q H^2. Its denominator is read factor by factor; so is its numerator, as that of 1/g, but for
 * a constant factor, which goes into Q. */
static bool
divide_square(qdot_loop_task *l, qdot_expr g, qdot_expr u, qdot_loop_square *s)
{
    qdot_integral_task *t = &l->t;
    qdot_reading top, bottom; /* the factors of 1/g, those of g, below */
    qdot_poly n;
    qdot_expr c;

    if (!qdot_reading_make(t, g, u, &bottom) || bottom.n > 0 || !qdot_reading_make(t, qdot_div(l->pool, QDOT_ONE, g), u, &top) ||
        top.n > 0)
        return false;
    n = qdot_poly_read(t, bottom.numerator, u);
    if (n.degree < 0)
        return false;
    c = qdot_mul(l->pool, bottom.rest, qdot_div(l->pool, qdot_poly_coefficient(&n, n.degree), leading(l, &top, u)));
    *s = (qdot_loop_square){.Q = qdot_poly_constant(t, qdot_integral_normal(t, c)), .over = qdot_poly_constant(t, QDOT_ONE)};
    for (int i = 0; i < top.factors; i++)
        if (!take_factor(l, s, top.factor[i].base, top.factor[i].power, u))
            return false;
    for (int i = 0; i < bottom.factors; i++)
        if (!take_factor(l, s, bottom.factor[i].base, -bottom.factor[i].power, u))
            return false;
    return s->Q.degree != -2 && s->over.degree != -2;
}

/* The loop of sqrt(g(u)); `both`: from -b to b. */
static qdot_expr
integrate_rational(qdot_loop_task *l, qdot_expr g, qdot_expr u, bool both)
{
    qdot_loop_square s;

    if (g == QDOT_NIL || g == QDOT_ZERO || !divide_square(l, g, u, &s))
        return QDOT_NIL;
    return s.Q.degree == 2   ? qdot_loop_residues(l, &s)
           : s.Q.degree == 4 ? qdot_loop_biquadratic(l, &s, both)
                             : QDOT_NIL;
}

/* --- substitutions --------------------------------------------------------------------------- */

/* The functions of x in a reading: sine and cosine of one angle, circular or hyperbolic. */
typedef struct {
    qdot_expr n, d;         /* the square is n/d */
    qdot_expr S, C;         /* the symbols in n and d of the sine, or hyperbolic sine, and of its cosine */
    qdot_expr angle, slope; /* k x + ..., and k */
} waves;

/* n/d with `square` for V^2, where V cancels then; nil where it does not. */
static qdot_expr
without(qdot_loop_task *l, qdot_expr n, qdot_expr d, qdot_expr V, qdot_expr square)
{
    qdot_expr even[2], odd[2];

    if (!qdot_poly_read_root(&l->t, n, V, square, &even[0], &odd[0]) || !qdot_poly_read_root(&l->t, d, V, square, &even[1], &odd[1]))
        return QDOT_NIL;
    for (int i = 0; i < 2; i++) {
        even[i] = qdot_integral_normal(&l->t, even[i]);
        odd[i] = qdot_integral_normal(&l->t, odd[i]);
    }
    if (odd[0] == QDOT_ZERO && odd[1] == QDOT_ZERO && even[1] != QDOT_ZERO)
        return qdot_div(l->pool, even[0], even[1]);
    return even[0] == QDOT_ZERO && even[1] == QDOT_ZERO && odd[1] != QDOT_ZERO ? qdot_div(l->pool, odd[0], odd[1]) : QDOT_NIL;
}

/* Whether lo pi/2 <= angle <= hi pi/2 is proved. */
static bool
value_between(qdot_loop_task *l, qdot_expr angle, int64_t lo, int64_t hi)
{
    qdot_pool *pool = l->pool;
    const qdot_expr right = qdot_mul(pool, QDOT_HALF, QDOT_PI);

    for (int i = 0; i < 2; i++) {
        const qdot_expr end = qdot_mul(pool, qdot_expr_int(pool, i == 0 ? lo : hi), right);
        const qdot_expr gap = i == 0 ? qdot_sub(pool, angle, end) : qdot_sub(pool, end, angle);
        qdot_expr where = QDOT_NIL;
        bool proved = false;

        if (gap == QDOT_NIL || qdot_inequality(pool, gap, false, l->facts, &proved, &where) != QDOT_OK || !proved)
            return false;
    }
    return true;
}

/* The same in the whole range of x, if not by the declared domain of x then at the ends. */
static bool
angle_between(qdot_loop_task *l, qdot_expr angle, int64_t lo, int64_t hi)
{
    return value_between(l, angle, lo, hi) || (value_between(l, qdot_subs(l->pool, angle, 1, &l->x, &l->lo), lo, hi) &&
                                               value_between(l, qdot_subs(l->pool, angle, 1, &l->x, &l->hi), lo, hi));
}

/* The loop over u, with f as a quotient in u and (dx/du)^2; nil: f is nil, or the loop is not found. */
static qdot_expr
over_new(qdot_loop_task *l, qdot_expr f, qdot_expr u, qdot_expr scale)
{
    return f == QDOT_NIL ? QDOT_NIL : integrate_rational(l, qdot_mul(l->pool, f, scale), u, false);
}

/* (dx/du)^2 = 1/(k^2 e), where (du/dx)^2 is k^2 e, k the slope of the angle. */
static qdot_expr
scale_of(qdot_loop_task *l, const waves *w, qdot_expr e)
{
    return qdot_pow_int(l->pool, qdot_mul(l->pool, qdot_mul(l->pool, w->slope, w->slope), e), -1);
}

/* Over the tangent u = S/C, circular or hyperbolic, with S = u C and C^2 = 1/e: e is 1 + u^2 or 1 - u^2. */
static qdot_expr
over_tangent(qdot_loop_task *l, const waves *w, bool hyperbolic)
{
    qdot_pool *pool = l->pool;
    const qdot_expr u = qdot_integral_variable(&l->t, false), uu = qdot_mul(pool, u, u), S = qdot_mul(pool, u, w->C),
                    e = hyperbolic ? qdot_sub(pool, QDOT_ONE, uu) : qdot_add(pool, QDOT_ONE, uu),
                    f = without(l, qdot_subs(pool, w->n, 1, &w->S, &S), qdot_subs(pool, w->d, 1, &w->S, &S), w->C,
                                qdot_pow_int(pool, e, -1));

    return over_new(l, f, u, scale_of(l, w, qdot_mul(pool, e, e)));
}

/* Over the cosine, where the angle or its negative is in 0 ... pi, whose ends are branch points then. */
static qdot_expr
over_cosine(qdot_loop_task *l, const waves *w)
{
    const qdot_expr cc = qdot_sub(l->pool, QDOT_ONE, qdot_mul(l->pool, w->C, w->C));

    return angle_between(l, w->angle, 0, 2) || angle_between(l, w->angle, -2, 0)
               ? over_new(l, without(l, w->n, w->d, w->S, cc), w->C, scale_of(l, w, cc))
               : QDOT_NIL;
}

/* Over the cosine, the sine or the tangent, where it is monotonic. */
static qdot_expr
over_circular(qdot_loop_task *l, const waves *w)
{
    qdot_pool *pool = l->pool;
    const qdot_expr ss = qdot_sub(pool, QDOT_ONE, qdot_mul(pool, w->S, w->S));
    qdot_expr value;

    if (!angle_between(l, w->angle, -1, 1))
        return over_cosine(l, w);
    value = over_new(l, without(l, w->n, w->d, w->C, ss), w->S, scale_of(l, w, ss));
    if (value != QDOT_NIL)
        return value;
    value = over_tangent(l, w, false);
    return value != QDOT_NIL ? value : over_cosine(l, w);
}

/* Over the hyperbolic tangent or sine. */
static qdot_expr
over_hyperbolic(qdot_loop_task *l, const waves *w)
{
    const qdot_expr ss = qdot_add(l->pool, QDOT_ONE, qdot_mul(l->pool, w->S, w->S)), value = over_tangent(l, w, true);

    return value != QDOT_NIL ? value : over_new(l, without(l, w->n, w->d, w->C, ss), w->S, scale_of(l, w, ss));
}

/* What was read as functions of one angle or exponent; false: it is something else. */
static bool
read_waves(qdot_loop_task *l, const qdot_reading *r, qdot_gen_kind of_sine, qdot_gen_kind of_cosine, waves *w)
{
    *w = (waves){.n = qdot_mul(l->pool, r->rest, r->numerator), .d = qdot_reading_denominator(&l->t, r),
                 .S = qdot_integral_variable(&l->t, false), .C = qdot_integral_variable(&l->t, false)};
    if (r->bare || r->n == 0 || r->n > 2)
        return false;
    for (int i = 0; i < r->n; i++) {
        if ((r->generator[i].kind != of_sine && r->generator[i].kind != of_cosine) || r->generator[i].of != r->generator[0].of)
            return false;
        *(r->generator[i].kind == of_sine ? &w->S : &w->C) = r->generator[i].symbol;
    }
    w->angle = r->generator[0].of;
    w->slope = qdot_integral_slope(l->pool, w->angle, l->x);
    return w->slope != QDOT_NIL && w->slope != QDOT_ZERO;
}

/* Over x^2, 0 <= lo; x = 0 is a branch point then. */
static qdot_expr
over_square(qdot_loop_task *l, const qdot_reading *r)
{
    qdot_pool *pool = l->pool;
    const qdot_expr u = qdot_integral_variable(&l->t, true);

    return over_new(l, without(l, qdot_mul(pool, r->rest, r->numerator), qdot_reading_denominator(&l->t, r), l->x, u), u,
                    qdot_pow_int(pool, qdot_mul(pool, qdot_expr_int(pool, 4), u), -1));
}

/* Over the hyperbolic cosine, where the range begins at angle 0. */
static qdot_expr
over_hyperbolic_cosine(qdot_loop_task *l, const waves *w)
{
    const qdot_expr cc = qdot_sub(l->pool, qdot_mul(l->pool, w->C, w->C), QDOT_ONE);

    return over_new(l, without(l, w->n, w->d, w->S, cc), w->C, scale_of(l, w, cc));
}

/* Whether the range and f are symmetric about 0. */
static bool
is_symmetric(qdot_loop_task *l)
{
    const qdot_expr opposite = qdot_neg(l->pool, l->x);

    return qdot_is_zero(l->pool, qdot_add(l->pool, l->lo, l->hi), l->facts) &&
           qdot_is_zero(l->pool, qdot_sub(l->pool, l->f, qdot_subs(l->pool, l->f, 1, &l->x, &opposite)), l->facts);
}

/* From end to end, both branch points of f. */
static qdot_expr
integrate_range(qdot_loop_task *l, const qdot_reading *r, bool both)
{
    waves w;

    if (r->n == 0) {
        const qdot_expr value = integrate_rational(l, l->f, l->x, both);

        return value != QDOT_NIL || !((qdot_expr_sign(l->pool, l->x) | qdot_expr_sign(l->pool, l->lo)) & QDOT_GE0) ? value : over_square(l, r);
    }
    if (r->n == 1 && !r->bare && r->generator[0].kind == QDOT_GEN_EXP) {
        const qdot_expr u = r->generator[0].symbol, top = qdot_mul(l->pool, r->rest, r->numerator);

        w.slope = qdot_integral_slope(l->pool, r->generator[0].of, l->x);
        return w.slope == QDOT_NIL ? QDOT_NIL
                                   : over_new(l, qdot_div(l->pool, top, qdot_reading_denominator(&l->t, r)), u,
                                              scale_of(l, &w, qdot_mul(l->pool, u, u)));
    }
    if (read_waves(l, r, QDOT_GEN_SIN, QDOT_GEN_COS, &w))
        return over_circular(l, &w);
    return read_waves(l, r, QDOT_GEN_SINH, QDOT_GEN_COSH, &w) ? over_hyperbolic(l, &w) : QDOT_NIL;
}

/* Of an even f twice the loop from 0, over an even function of x. */
static qdot_expr
integrate_half(qdot_loop_task *l, const qdot_reading *r)
{
    qdot_expr value = QDOT_NIL;
    waves w;

    l->lo = QDOT_ZERO;
    if (r->n == 0)
        value = over_square(l, r);
    else if (read_waves(l, r, QDOT_GEN_SIN, QDOT_GEN_COS, &w))
        value = over_cosine(l, &w);
    else if (read_waves(l, r, QDOT_GEN_SINH, QDOT_GEN_COSH, &w))
        value = over_hyperbolic_cosine(l, &w);
    return value == QDOT_NIL ? QDOT_NIL : qdot_mul(l->pool, qdot_expr_int(l->pool, 2), value);
}

static void
search_loop(void *user)
{
    qdot_loop_task *l = user;
    qdot_reading r;
    bool both;

    if (!qdot_reading_make(&l->t, l->f, l->x, &r))
        return;
    l->value = qdot_loop_pendulum(l, &r);
    if (l->value != QDOT_NIL || l->lo == QDOT_NIL)
        return;
    both = is_symmetric(l);
    l->value = integrate_range(l, &r, both);
    if (l->value == QDOT_NIL && both)
        l->value = integrate_half(l, &r);
}

static qdot_expr
find_loop(qdot_loop_task *l)
{
    qdot_pool *pool = l->pool;
    qdot_budget budget;
    qdot_status status;

    if (l->f == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    budget = qdot_budget_begin(pool, CONSTRUCTIONS);
    status = qdot_flint_run(pool, search_loop, l);
    qdot_budget_end(pool, &budget);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (status != QDOT_OK || qdot_pool_failed(pool))
        return qdot_grave(qdot_pool_check(pool)) != QDOT_OK ? qdot_pool_fail(pool) : QDOT_NIL;
    return l->value == QDOT_NIL ? QDOT_NIL : qdot_simplify(pool, l->value, l->facts);
}

qdot_expr
qdot_loop(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts)
{
    qdot_loop_task l = {{.pool = pool, .facts = facts, .effort = EFFORT}, pool, facts, f, x, lo, hi, QDOT_NIL};

    return find_loop(&l);
}

qdot_expr
qdot_loop_turn(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts)
{
    qdot_loop_task l = {{.pool = pool, .facts = facts, .effort = EFFORT}, pool, facts, f, x, QDOT_NIL, QDOT_NIL, QDOT_NIL};

    return find_loop(&l);
}
