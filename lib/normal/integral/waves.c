/* waves.c -- integrates sums of x^n exp(E) cos(V) and x^n exp(E) sin(V), E and V linear in x, and products of these.
 *
 * Products of sines and cosines become sums. With E' = a, V' = w and (P cos V + Q sin V) exp(E) as the integral of
 * c x^n exp(E) cos V:
 *
 *     P' + a P + w Q = c x^n,   Q' + a Q - w P = 0.
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/integral/methods.h"
#include "normal/integral/polynomial.h"

enum { MOST_WAVES = 48, MOST_POWER = 12 };

/* c x^n E sin V or c x^n E cos V; E a product of exponentials with E'/E = rate. */
typedef struct {
    qdot_expr c, E, rate, V;
    int64_t n;
    bool sine;
} wave;

typedef struct {
    size_t n;
    wave at[MOST_WAVES];
} waves;

static bool
add_wave(waves *w, wave a)
{
    if (a.c == QDOT_NIL || a.E == QDOT_NIL || a.rate == QDOT_NIL || a.V == QDOT_NIL)
        return false;
    if (a.c == QDOT_ZERO || (a.sine && a.V == QDOT_ZERO))
        return true;
    if (w->n == MOST_WAVES)
        return false;
    w->at[w->n++] = a;
    return true;
}

/* Multiply w by sin u or cos u. */
static bool
times_circular(qdot_pool *pool, waves *w, qdot_expr u, bool sine)
{
    waves r = {0};

    for (size_t i = 0; i < w->n; i++) {
        wave a = w->at[i], b = a;
        qdot_expr half = qdot_mul(pool, QDOT_HALF, a.c);

        a.c = b.c = half;
        a.V = qdot_add(pool, w->at[i].V, u);
        b.V = qdot_sub(pool, w->at[i].V, u);
        a.sine = b.sine = w->at[i].sine != sine;
        if (sine) { /* sin V sin u = (cos(V - u) - cos(V + u))/2, cos V sin u = (sin(V + u) - sin(V - u))/2 */
            qdot_expr minus = qdot_neg(pool, half);

            *(w->at[i].sine ? &a.c : &b.c) = minus;
        }
        if (!add_wave(&r, a) || !add_wave(&r, b))
            return false;
    }
    *w = r;
    return true;
}

/* Multiply w by E = exp of something with the slope `rate`. */
static void
times_exponential(qdot_pool *pool, waves *w, qdot_expr E, qdot_expr rate)
{
    for (size_t i = 0; i < w->n; i++) {
        w->at[i].E = qdot_mul(pool, w->at[i].E, E);
        w->at[i].rate = qdot_add(pool, w->at[i].rate, rate);
    }
}

/* Multiply w by sinh u or cosh u. */
static bool
times_hyperbolic(qdot_pool *pool, waves *w, qdot_expr u, qdot_expr slope, bool sine)
{
    waves r = *w, s = *w;

    times_exponential(pool, &r, qdot_fun1(pool, QDOT_EXP, u), slope);
    times_exponential(pool, &s, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, u)), qdot_neg(pool, slope));
    w->n = 0;
    for (size_t i = 0; i < r.n; i++) {
        r.at[i].c = qdot_mul(pool, QDOT_HALF, r.at[i].c);
        s.at[i].c = qdot_mul(pool, sine ? qdot_neg(pool, QDOT_HALF) : QDOT_HALF, s.at[i].c);
        if (!add_wave(w, r.at[i]) || !add_wave(w, s.at[i]))
            return false;
    }
    return true;
}

/* Multiply w by base^exponent; false: that is no power of x, exponential, sine or cosine. */
static bool
times_factor(qdot_pool *pool, waves *w, qdot_expr base, qdot_expr exponent, qdot_expr x)
{
    qdot_expr slope, u;
    qdot_fun_id id;
    int64_t k;

    slope = qdot_expr_contains(pool, base, x) ? QDOT_NIL : qdot_integral_slope(pool, exponent, x);
    if (slope != QDOT_NIL) {
        times_exponential(pool, w, qdot_pow(pool, base, exponent), qdot_mul(pool, slope, qdot_fun1(pool, QDOT_LOG, base)));
        return true;
    }
    if (!qdot_expr_to_int(pool, exponent, &k) || k < -MOST_POWER || k > MOST_POWER)
        return false;
    if (base == x && k > 0) {
        for (size_t i = 0; i < w->n; i++)
            w->at[i].n += k;
        return true;
    }
    if (qdot_expr_kind(pool, base) != QDOT_FUN || qdot_expr_count(pool, base) != 1)
        return false;
    u = qdot_expr_arg(pool, base, 0);
    id = (qdot_fun_id)qdot_expr_node(pool, base)->op;
    slope = qdot_integral_slope(pool, u, x);
    if (slope == QDOT_NIL)
        return false;
    if (id == QDOT_EXP) {
        times_exponential(pool, w, qdot_pow(pool, base, exponent), qdot_mul(pool, slope, exponent));
        return true;
    }
    for (; k > 0; k--) {
        bool done = false;

        if (id == QDOT_SIN || id == QDOT_COS)
            done = times_circular(pool, w, u, id == QDOT_SIN);
        else if (id == QDOT_SINH || id == QDOT_COSH)
            done = times_hyperbolic(pool, w, u, slope, id == QDOT_SINH);
        if (!done)
            return false;
    }
    return k == 0;
}

/* Write a term whose factors all hold x as a sum of waves. */
static bool
read_waves(qdot_pool *pool, qdot_expr term, qdot_expr x, waves *w)
{
    bool product = qdot_expr_kind(pool, term) == QDOT_PROD;
    uint32_t n = product ? qdot_expr_count(pool, term) : 3;

    *w = (waves){1, {{product ? qdot_expr_arg(pool, term, 0) : QDOT_ONE, QDOT_ONE, QDOT_ZERO, QDOT_ZERO, 0, false}}};
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr base = product ? qdot_expr_arg(pool, term, i) : term;
        qdot_expr exponent = product ? qdot_expr_arg(pool, term, i + 1) : QDOT_ONE;

        if (!times_factor(pool, w, base, exponent, x))
            return false;
    }
    return true;
}

/* The integral of a wave. */
static qdot_expr
integrate_wave(qdot_integral_task *t, const wave *a, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr w = qdot_diff(pool, a->V, x), norm, p, q, F = QDOT_ZERO, f, g, rate = qdot_integral_normal(t, a->rate);
    qdot_expr c = a->c, d = QDOT_ZERO; /* the coefficients of x^k cos V and x^k sin V still to be integrated */

    w = qdot_integral_normal(t, w);
    if (w == QDOT_NIL || rate == QDOT_NIL)
        return QDOT_NIL;
    norm = qdot_integral_normal(t, qdot_add(pool, qdot_mul(pool, rate, rate), qdot_mul(pool, w, w)));
    f = qdot_fun1(pool, QDOT_COS, a->V);
    g = qdot_fun1(pool, QDOT_SIN, a->V);
    if (a->sine) {
        c = QDOT_ZERO;
        d = a->c;
    }
    if (norm == QDOT_ZERO) /* the wave is a power of x */
        return qdot_mul(pool, qdot_mul(pool, a->E, qdot_add(pool, qdot_mul(pool, c, f), qdot_mul(pool, d, g))),
                        qdot_div(pool, qdot_pow_int(pool, x, a->n + 1), qdot_expr_int(pool, a->n + 1)));
    for (int64_t k = a->n; k >= 0 && qdot_integral_goes(t); k--) {
        /* a p + w q = c, a q - w p = d */
        p = qdot_sub(pool, qdot_mul(pool, rate, c), qdot_mul(pool, w, d));
        q = qdot_add(pool, qdot_mul(pool, w, c), qdot_mul(pool, rate, d));
        p = qdot_integral_normal(t, qdot_div(pool, p, norm));
        q = qdot_integral_normal(t, qdot_div(pool, q, norm));
        F = qdot_add(pool, F, qdot_mul(pool, qdot_pow_int(pool, x, k),
                                       qdot_add(pool, qdot_mul(pool, p, f), qdot_mul(pool, q, g))));
        c = qdot_mul(pool, qdot_expr_int(pool, -k), p);
        d = qdot_mul(pool, qdot_expr_int(pool, -k), q);
    }
    return qdot_mul(pool, a->E, F);
}

qdot_expr
qdot_waves_integrate(qdot_integral_task *t, qdot_expr e, qdot_expr x)
{
    qdot_pool *pool = t->pool;
    qdot_expr sum = QDOT_ZERO;
    uint32_t n;
    waves w;

    e = qdot_expand(pool, e);
    if (e == QDOT_NIL)
        return e;
    n = qdot_expr_kind(pool, e) == QDOT_SUM ? qdot_expr_count(pool, e) : 1;
    for (uint32_t i = n == 1 ? 0 : 1; i < n && sum != QDOT_NIL; i += 2) {
        qdot_expr term = n == 1 ? e : qdot_mul(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1));
        qdot_expr free, rest, part = QDOT_ZERO;

        qdot_integral_split(pool, term, x, &free, &rest);
        if (!read_waves(pool, rest, x, &w))
            return QDOT_NIL;
        for (size_t k = 0; k < w.n && part != QDOT_NIL; k++)
            part = qdot_add(pool, part, integrate_wave(t, &w.at[k], x));
        sum = qdot_add(pool, sum, qdot_mul(pool, free, part));
    }
    if (n > 1)
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_expr_arg(pool, e, 0), x));
    return sum;
}
