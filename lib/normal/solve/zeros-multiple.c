/* zeros-multiple.c -- one unknown: places where no simple zero can be proved in doubles.
 *
 * If f, f' .. f^(k-1) vanish at c, exactly, and f^(k) does not vanish on an interval about c, then c is the
 * only zero in there, of multiplicity k. Else balls with more bits tell close zeros apart. */
#include <math.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"
#include "normal/solve/zeros-parts.h"

/* MOST_GROWN: undecided intervals at which the growth of terms is examined. */
enum { MULTIPLICITY = 6, BITS = 512, DEPTH = 200, STEPS = 2000, LONGEST = 100, MOST_GROWN = 32 };

/* --- guessing exact zeros --------------------------------------------------------------------------- */

/* Whether f is monotonic on each side of c within X; at c it may have a kink. */
static bool
is_monotone_beside(qdot_zeros_system *s, qdot_interval c, qdot_interval X)
{
    const qdot_interval sides[] = {{X.lo, c.lo}, {c.hi, X.hi}};
    bool yes = c.lo == c.hi;

    for (int k = 0; k < 2 && yes; k++) {
        const qdot_enclosure_value *v;

        qdot_enclosure_eval(s->bounds, &sides[k], true);
        s->evaluations++;
        v = qdot_enclosure_get(s->bounds, 0);
        yes = v->state == QDOT_ENCLOSURE_WHOLE &&
              (v->slope[0].lo > 0 || v->slope[0].hi < 0);
    }
    return yes;
}

/* Whether c is proved to be the only zero of f within the interval X; *k: the multiplicity of this zero. */
static qdot_status
is_only_zero(qdot_zeros_system *s, qdot_expr c, qdot_interval X, int *k)
{
    qdot_expr f = s->f[0];
    bool vanishes;

    for (*k = 0; *k <= MULTIPLICITY; ++*k) {
        qdot_enclosure *bounds;
        const qdot_enclosure_value *v;
        bool nonzero;

        QDOT_TRY(qdot_enclosure_new(s->pool, 1, &f, 1, s->x, &bounds));
        qdot_enclosure_eval(bounds, &X, false);
        v = qdot_enclosure_get(bounds, 0);
        nonzero = v->state == QDOT_ENCLOSURE_WHOLE && (v->y.lo > 0 || v->y.hi < 0);
        qdot_enclosure_free(bounds);
        s->evaluations++;
        if (nonzero)
            return QDOT_OK;
        QDOT_TRY(qdot_zeros_vanish(s->pool, 1, &f, 1, s->x, &c, &vanishes));
        if (!vanishes)
            break;
        f = qdot_diff(s->pool, f, s->x[0]);
        QDOT_TRY(qdot_pool_check(s->pool));
    }
    *k = 0;
    return QDOT_OK;
}

/* Whether f, which vanishes at the end c of its range, has no other zero within `reach` on the side `side` of c. Its
 * slope may be infinite there, as that of sqrt(x) - sin(x) is at 0:
 *
 *     x = c +- y^m,   y >= 0,   m such that f rises or falls in y. */
static qdot_status
is_only_zero_at_end(qdot_zeros_system *s, qdot_expr c, int side, double reach, bool *yes)
{
    static const int64_t orders[] = {2, 3, 4, 6};
    qdot_pool *pool = s->pool;
    qdot_expr y = qdot_symbol_get(pool, QDOT_FORMAL, "end#y");
    bool jumps;

    *yes = false;
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_symbol(pool, y)->lo == QDOT_NIL)
        qdot_symbol_domain(pool, y, QDOT_ZERO, true, QDOT_NIL, false);
    QDOT_TRY(qdot_jumps(pool, s->f[0], UINT32_MAX, &jumps));
    for (size_t i = 0; i < sizeof orders / sizeof *orders && !*yes && !jumps; i++) {
        qdot_interval Y = {0, 1.01 * pow(reach, 1 / (double)orders[i])};
        qdot_expr to = qdot_add(pool, c, qdot_mul(pool, qdot_expr_int(pool, side),
                                                  qdot_pow_int(pool, y, orders[i]))),
                  slope = qdot_diff(pool, qdot_subs(pool, s->f[0], 1, s->x, &to), y);
        qdot_enclosure *bounds;
        qdot_status status;

        slope = qdot_simplify(pool, slope, NULL);
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN)
            continue;
        QDOT_TRY(status);
        QDOT_TRY(qdot_enclosure_new(pool, 1, &slope, 1, &y, &bounds));
        qdot_enclosure_eval(bounds, &Y, false);
        s->evaluations++;
        *yes = qdot_enclosure_get(bounds, 0)->state == QDOT_ENCLOSURE_WHOLE &&
               (qdot_enclosure_get(bounds, 0)->y.lo > 0 ||
                qdot_enclosure_get(bounds, 0)->y.hi < 0);
        qdot_enclosure_free(bounds);
    }
    return qdot_pool_check(pool);
}

/* The value of a root; for a periodic root the member of its family that is nearest to v; nil if that is not known. */
static qdot_expr
nearest_member(qdot_pool *pool, const qdot_root *root, double v)
{
    double at, period;

    if (root->period == QDOT_NIL)
        return root->value;
    if (!qdot_ball_double(pool, root->value, NULL, NULL, &at) ||
        !qdot_ball_double(pool, root->period, NULL, NULL, &period) ||
        !(fabs(v - at) < 1e9 * fabs(period)))
        return QDOT_NIL;
    return qdot_add(pool, root->value,
                    qdot_mul(pool, qdot_expr_int(pool, llround((v - at) / period)),
                             root->period));
}

/* The roots known by formulas near X, as a LIST: a zero that is multiple in doubles may have a
 * simple formula. */
static qdot_status
list_roots_near(qdot_zeros_system *s, const qdot_solutions *roots, qdot_interval X,
                qdot_expr *list)
{
    qdot_interval wide = {X.lo - 1e-6 * fmax(fabs(X.lo), 1),
                          X.hi + 1e-6 * fmax(fabs(X.hi), 1)};

    *list = qdot_list(s->pool, 0, NULL);
    for (size_t i = 0; i < roots->root.n; i++) {
        qdot_expr c = nearest_member(s->pool, &roots->root.at[i], X.lo / 2 + X.hi / 2);
        double at;

        QDOT_TRY(qdot_pool_check(s->pool));
        if (c != QDOT_NIL && qdot_ball_double(s->pool, c, NULL, NULL, &at) &&
            at > wide.lo && at < wide.hi)
            *list = qdot_conditions_and(s->pool, *list, c);
    }
    return qdot_pool_check(s->pool);
}

/* Find the roots of a short equation by formulas; none if no formula is known. */
static qdot_status
solve_by_formulas(qdot_zeros_system *s, qdot_solutions *roots)
{
    qdot_status status;

    *roots = (qdot_solutions){0};
    if (qdot_expr_size(s->pool, s->f[0]) > LONGEST)
        return QDOT_OK;
    status = qdot_solve(s->pool, s->f[0], s->x[0], NULL, roots);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Decide an undecided interval X as one exact zero: one of the list, an end of the range, a root by
 * formula, or a simple number. */
static qdot_status
decide_as_exact_zero(qdot_zeros_system *s, qdot_expr list, bool ends, qdot_interval X,
                     bool *decided)
{
    double more = X.hi - X.lo + 1e-9 * fmax(fabs(X.lo), 1e-3);
    qdot_interval wide = {X.lo - more, X.hi + more};
    uint32_t n = qdot_expr_count(s->pool, list);

    *decided = false;
    for (uint32_t i = 0; i < n + (ends ? 2 : 0) && !*decided; i++) {
        qdot_expr c = i < n ? qdot_expr_arg(s->pool, list, i)
                            : qdot_zeros_candidate(s->pool, X, (int)(i - n));
        qdot_zero_place place = {.simple = false};
        qdot_interval at;
        int k;

        QDOT_TRY(qdot_pool_check(s->pool));
        if (c == QDOT_NIL)
            continue;
        at = qdot_ball_bounds(s->pool, c);
        if (!(at.lo >= wide.lo && at.hi <= wide.hi))
            continue;
        QDOT_TRY(is_only_zero(s, c, wide, &k));
        if (k == 0) {
            bool only = false;

            QDOT_TRY(qdot_zeros_vanish(s->pool, 1, s->f, 1, s->x, &c, &only));
            if (!only)
                continue;
            only = is_monotone_beside(s, at, wide);
            if (!only && ends && i < n) { /* the search range ends at this zero: it suffices to decide one side */
                int side = X.hi - at.hi > at.lo - X.lo ? 1 : -1;

                QDOT_TRY(is_only_zero_at_end(
                    s, c, side, side > 0 ? wide.hi - at.lo : at.hi - wide.lo, &only));
            }
            if (!only)
                continue;
        }
        place.at[0] = at.lo / 2 + at.hi / 2;
        place.radius[0] = fmax(at.hi - place.at[0], place.at[0] - at.lo);
        place.alone[0] = wide;
        place.simple = k == 1;
        QDOT_TRY(qdot_vec_push(&s->found, place));
        *decided = true;
    }
    return QDOT_OK;
}

/* --- more than double precision --------------------------------------------------------------------------- */

typedef struct {
    qdot_zeros_system *s;
    qdot_expr e[2]; /* f and f' for evaluation in balls */
    qdot_ball ball;
    arb_t at;
    int steps;
} fine;

static bool
value_of_unknown(void *user, qdot_expr atom, arb_t value, slong prec)
{
    fine *d = user;

    (void)prec;
    if (atom != d->s->x[0])
        return false;
    arb_set(value, d->at);
    return true;
}

/* The sign of e[i] (f or f') on the interval lo .. hi, a point if lo = hi; 0 if not known. */
static int
sign_over_interval(fine *d, int i, const arf_t lo, const arf_t hi)
{
    arb_srcptr v;

    d->steps++;
    d->s->evaluations += 4;
    arb_set_interval_arf(d->at, lo, hi, BITS);
    qdot_ball_eval(&d->ball, BITS, value_of_unknown, d);
    v = qdot_ball_get(&d->ball, d->e[i]);
    return v == NULL ? 0 : arb_is_positive(v) ? 1 : arb_is_negative(v) ? -1 : 0;
}

/* Find the zero between lo and hi, where f is monotone and changes its sign, to double precision. */
static qdot_status
append_zero(fine *d, arf_t lo, arf_t hi, int below)
{
    qdot_zero_place place = {.simple = true};
    arf_t m;

    arf_init(m);
    place.alone[0] =
        (qdot_interval){arf_get_d(lo, ARF_RND_CEIL), arf_get_d(hi, ARF_RND_FLOOR)};
    for (int k = 0;
         k < DEPTH && arf_get_d(lo, ARF_RND_NEAR) != arf_get_d(hi, ARF_RND_NEAR); k++) {
        int sign;

        arf_add(m, lo, hi, BITS, ARF_RND_NEAR);
        arf_mul_2exp_si(m, m, -1);
        sign = sign_over_interval(d, 0, m, m);
        if (sign == 0)
            break;
        arf_set(sign == below ? lo : hi, m);
    }
    place.at[0] = arf_get_d(lo, ARF_RND_NEAR);
    arf_sub_si(m, hi, 0, BITS, ARF_RND_CEIL);
    place.radius[0] = fmax(arf_get_d(hi, ARF_RND_CEIL) - place.at[0],
                           place.at[0] - arf_get_d(lo, ARF_RND_FLOOR));
    arf_clear(m);
    if (!(place.alone[0].lo <= place.at[0] - place.radius[0] &&
          place.alone[0].hi >= place.at[0] + place.radius[0]))
        place.alone[0] =
            (qdot_interval){place.at[0] - place.radius[0], place.at[0] + place.radius[0]};
    return qdot_vec_push(&d->s->found, place);
}

/* Find the zeros in lo .. hi by halving; record intervals that cannot be decided as undecided. */
static qdot_status
search_by_halving(fine *d, const arf_t lo, const arf_t hi, int depth)
{
    int a = sign_over_interval(d, 0, lo, lo), b = sign_over_interval(d, 0, hi, hi);
    qdot_status status = QDOT_OK;

    if (sign_over_interval(d, 0, lo, hi) != 0)
        return QDOT_OK;
    if (d->steps > STEPS || depth > DEPTH || a == 0 || b == 0) {
        qdot_zero_box left = {
            .at = {{arf_get_d(lo, ARF_RND_FLOOR), arf_get_d(hi, ARF_RND_CEIL)}}};

        return qdot_vec_push(&d->s->doubt, left);
    }
    if (sign_over_interval(d, 1, lo, hi) != 0) { /* the function is monotone */
        arf_t x, y;

        if (a == b)
            return QDOT_OK;
        arf_init(x);
        arf_init(y);
        arf_set(x, lo);
        arf_set(y, hi);
        status = append_zero(d, x, y, a);
        arf_clear(x);
        arf_clear(y);
    } else {
        arf_t m;

        arf_init(m); /* do not cut the interval in the middle, where zeros often lie */
        arf_sub(m, hi, lo, BITS, ARF_RND_NEAR);
        arf_mul_si(m, m, 31, BITS, ARF_RND_NEAR);
        arf_mul_2exp_si(m, m, -6);
        arf_add(m, m, lo, BITS, ARF_RND_NEAR);
        status = search_by_halving(d, lo, m, depth + 1);
        if (status == QDOT_OK)
            status = search_by_halving(d, m, hi, depth + 1);
        arf_clear(m);
    }
    return status;
}

static qdot_status
decide_with_more_bits(qdot_zeros_system *s, qdot_interval X)
{
    fine d = {.s = s, .e = {s->f[0], qdot_diff(s->pool, s->f[0], s->x[0])}};
    double more = 0.1 * (X.hi - X.lo) + 1e-13 * fmax(fabs(X.lo), 1e-3);
    qdot_status status;
    bool jumps;
    arf_t lo, hi;

    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_jumps(s->pool, s->f[0], UINT32_MAX, &jumps));
    if (jumps)
        return qdot_vec_push(&s->doubt, (qdot_zero_box){.at = {X}});
    QDOT_TRY(qdot_ball_begin(&d.ball, s->pool, 2, d.e));
    arb_init(d.at);
    arf_init(lo);
    arf_init(hi);
    arf_set_d(lo, X.lo - more);
    arf_set_d(hi, X.hi + more);
    status = search_by_halving(&d, lo, hi, 0);
    arf_clear(lo);
    arf_clear(hi);
    arb_clear(d.at);
    qdot_ball_end(&d.ball);
    return status;
}

/* --- places where f or its slope is undefined --- */

/* Whether f is undefined at `at`, or proved to be another number than 0 there. */
static qdot_status
is_proved_no_zero(const qdot_zeros_system *s, qdot_expr at, bool *yes)
{
    qdot_expr value = qdot_subs(s->pool, s->f[0], 1, s->x, &at);
    qdot_interval y;

    *yes = value == QDOT_NIL;
    if (*yes) {
        qdot_status status = qdot_pool_check(s->pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    y = qdot_ball_bounds(s->pool, value);
    *yes = y.lo > 0 || y.hi < 0;
    return qdot_pool_check(s->pool);
}

/* Whether f is proved to have no zeros within X: none at c, a number in X or beside it, and none of f(c + 1/u) for large u
 * and -u, by the growth of its terms. So near 0 with x log(x) or x^x in f, whose slopes have no bounds there. */
static qdot_status
exclude_by_growth(const qdot_zeros_system *s, qdot_interval X, bool *excluded)
{
    qdot_pool *pool = s->pool;
    const double beside = X.hi - X.lo;
    qdot_expr c = qdot_zeros_candidate(pool, (qdot_interval){X.lo - beside, X.hi + beside}, 0), to, g;
    qdot_interval at;

    *excluded = false;
    if (c == QDOT_NIL)
        return qdot_pool_check(pool);
    at = qdot_ball_bounds(pool, c);
    to = qdot_add(pool, c, qdot_pow_int(pool, s->x[0], -1));
    /* simplify, because terms that grow near c may cancel */
    g = qdot_simplify(pool, qdot_subs(pool, s->f[0], 1, s->x, &to), NULL);
    if (g == QDOT_NIL)
        return qdot_pool_check(pool) == QDOT_EDOMAIN ? QDOT_OK : qdot_last_error()->status;
    QDOT_TRY(is_proved_no_zero(s, c, excluded));
    for (int sign = -1; sign <= 1 && *excluded; sign += 2) {
        double width = sign > 0 ? X.hi - at.lo : at.hi - X.lo, R;

        QDOT_TRY(qdot_zeros_far(pool, g, s->x[0], sign, &R));
        *excluded = width * (1 + 1e-9) <= 1 / R;
    }
    return QDOT_OK;
}

qdot_status
qdot_zeros_decide_doubts(qdot_zeros_system *s, qdot_expr ends)
{
    size_t n = s->doubt.n;
    qdot_zero_box *before = s->doubt.at;
    qdot_solutions roots = {0};
    bool solved = false;
    qdot_status status = QDOT_OK;

    s->doubt.at = NULL;
    s->doubt.n = s->doubt.capacity = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_interval X = before[i].at[0];
        bool decided;

        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = decide_as_exact_zero(s, ends, true, X, &decided);
        if (status == QDOT_OK && !decided && !solved) {
            status = solve_by_formulas(s, &roots);
            solved = true;
        }
        if (status == QDOT_OK && !decided && roots.root.n > 0 && isfinite(X.lo) &&
            isfinite(X.hi)) {
            qdot_expr near;

            status = list_roots_near(s, &roots, X, &near);
            if (status == QDOT_OK)
                status = decide_as_exact_zero(s, near, false, X, &decided);
        }
        if (status == QDOT_OK && !decided && i < MOST_GROWN && isfinite(X.lo) && isfinite(X.hi))
            status = exclude_by_growth(s, X, &decided);
        if (status == QDOT_OK && !decided && isfinite(X.lo) && isfinite(X.hi))
            status = decide_with_more_bits(s, X);
        else if (status == QDOT_OK && !decided)
            status = qdot_vec_push(&s->doubt, before[i]);
    }
    qdot_solutions_clear(&roots);
    qdot_free(before);
    return status;
}
