/* wave-root.c -- integrates functions of the sine and cosine of one angle that hold roots, over the sine or the cosine.
 *
 *     int f(sin u, cos u) dx = 1/u' int f(s, c)/c ds,   s = sin u, c = sqrt(1 - s^2),
 *
 * where f/c is even in c, so that no root of 1 - s^2 is left; likewise over the cosine, and of sinh u and cosh u.
 *
 * Tests  tests/normal/integral/test_antiderivative.c
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"

typedef struct {
    qdot_integral_task *t;
    qdot_pool *pool;
    qdot_expr u, slope, x;
    bool hyperbolic;
} waves;

/* Whether f holds a root of `square`, a polynomial in w, or of a multiple of it. */
static bool
holds_root_of(qdot_integral_task *t, qdot_expr f, qdot_expr square, qdot_expr w)
{
    qdot_pool *pool = t->pool;
    bool found = false;
    qdot_walk walk;

    if (qdot_walk_begin(pool, f, &walk) != QDOT_OK)
        return true;
    for (size_t i = 0; i < walk.n && !found; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD && k < qdot_expr_count(pool, walk.at[i]); k += 2) {
            const qdot_expr base = qdot_expr_arg(pool, walk.at[i], k);
            qdot_expr ratio;
            int64_t n;

            if (found || qdot_expr_to_int(pool, qdot_expr_arg(pool, walk.at[i], k + 1), &n) || !qdot_expr_contains(pool, base, w))
                continue;
            ratio = qdot_integral_normal(t, qdot_div(pool, base, square));
            found = ratio == QDOT_NIL || !qdot_expr_contains(pool, ratio, w);
        }
    qdot_walk_end(&walk);
    return found;
}

/* e with s and c for the sine and the cosine. */
static qdot_expr
put_in(const waves *f, qdot_expr e, qdot_expr s, qdot_expr c)
{
    qdot_pool *pool = f->pool;
    const qdot_expr u = f->u, tangent = qdot_div(pool, s, c);

    if (f->hyperbolic)
        return qdot_subs(pool, e, 3,
                         (qdot_expr[]){qdot_fun1(pool, QDOT_SINH, u), qdot_fun1(pool, QDOT_COSH, u), qdot_fun1(pool, QDOT_TANH, u)},
                         (qdot_expr[]){s, c, tangent});
    return qdot_subs(pool, e, 6,
                     (qdot_expr[]){qdot_fun1(pool, QDOT_SIN, u), qdot_fun1(pool, QDOT_COS, u), qdot_fun1(pool, QDOT_TAN, u),
                                   qdot_fun1(pool, QDOT_COT, u), qdot_fun1(pool, QDOT_SEC, u), qdot_fun1(pool, QDOT_CSC, u)},
                     (qdot_expr[]){s, c, tangent, qdot_div(pool, c, s), qdot_div(pool, QDOT_ONE, c), qdot_div(pool, QDOT_ONE, s)});
}

/* Integrate one form over w, the sine or the cosine of u; nil: the other one is left. */
static qdot_expr
integrate_form(const waves *f, qdot_expr e, bool sine, int depth)
{
    qdot_pool *pool = f->pool;
    const qdot_expr w = qdot_integral_variable(f->t, !sine && f->hyperbolic), one = QDOT_ONE, ww = qdot_mul(pool, w, w);
    const qdot_expr square = !f->hyperbolic ? qdot_sub(pool, one, ww) : sine ? qdot_add(pool, one, ww) : qdot_sub(pool, ww, one);
    const qdot_expr other = qdot_sqrt(pool, square), rate = sine || f->hyperbolic ? other : qdot_neg(pool, other);
    qdot_expr F;

    e = qdot_div(pool, put_in(f, e, sine ? w : other, sine ? other : w), qdot_mul(pool, rate, f->slope));
    if (e == QDOT_NIL || qdot_expr_contains(pool, e, f->x))
        return QDOT_NIL;
    if (holds_root_of(f->t, e, square, w))
        e = qdot_integral_normal(f->t, e);
    if (e == QDOT_NIL || holds_root_of(f->t, e, square, w))
        return QDOT_NIL;
    F = qdot_integral_any(f->t, e, w, depth + 1);
    return F == QDOT_NIL ? F
                         : qdot_subs(pool, F, 1, &w,
                                     &(qdot_expr){qdot_fun1(pool, sine ? (f->hyperbolic ? QDOT_SINH : QDOT_SIN)
                                                                       : (f->hyperbolic ? QDOT_COSH : QDOT_COS),
                                                            f->u)});
}

qdot_expr
qdot_wave_root_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x, int depth)
{
    waves f = {.t = t, .pool = t->pool, .x = x};
    qdot_expr read, F = QDOT_NIL;
    bool root = false;
    qdot_reading r;

    if (depth > 2 || !qdot_reading_make(t, e, x, &r) || r.bare)
        return QDOT_NIL;
    read = qdot_div(t->pool, qdot_mul(t->pool, r.rest, r.numerator), qdot_reading_denominator(t, &r));
    for (int i = 0; i < r.n; i++) {
        const qdot_gen_kind kind = r.generator[i].kind;
        const bool hyperbolic = kind == QDOT_GEN_SINH || kind == QDOT_GEN_COSH;

        read = qdot_subs(t->pool, read, 1, &r.generator[i].symbol, &r.generator[i].expr);
        root |= kind == QDOT_GEN_ROOT;
        if (kind == QDOT_GEN_ROOT)
            continue;
        if (kind < QDOT_GEN_SIN || kind > QDOT_GEN_COSH ||
            (f.u != QDOT_NIL && (f.u != r.generator[i].of || f.hyperbolic != hyperbolic)))
            return QDOT_NIL;
        f.u = r.generator[i].of;
        f.hyperbolic = hyperbolic;
    }
    if (!root || f.u == QDOT_NIL)
        return QDOT_NIL;
    f.slope = qdot_integral_slope(t->pool, f.u, x);
    if (f.slope == QDOT_NIL)
        return QDOT_NIL;
    for (int sine = 1; sine >= 0 && F == QDOT_NIL && !t->failed; sine--) { /* as it stands, and as it was read */
        F = integrate_form(&f, e, sine, depth);
        if (F == QDOT_NIL && !t->failed)
            F = integrate_form(&f, read, sine, depth);
    }
    return F;
}
