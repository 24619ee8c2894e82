/* improper.c -- reads the numbers k, a, b, n off an integrand and compares it with the entries of the tables. */
#include "normal/integral/improper.h"

#include <flint/arith.h>
#include <flint/fmpq.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/inequality/less.h"

enum { MOST_RATES = 2, MOST_POWER = 15 };

/* What the integrand e holds; nil: nothing such. */
typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr e, x;
    qdot_expr k, k2;             /* sin or cos of k x; of k2 x^2 */
    qdot_expr decay[MOST_RATES]; /* exp(-decay x), the first two; 0 where there is none */
    qdot_expr grow;              /* exp(grow x) */
    qdot_expr gauss;             /* exp(-gauss x^2) */
    qdot_expr square;            /* x^2 + square */
    qdot_expr p, q;              /* x^4 + p x^2 + q */
    qdot_expr value;
    qdot_status status;
} table;

/* The factor c of u = c x^n; nil: u is another expression. */
static qdot_expr
factor_of_power(const table *t, qdot_expr u, int64_t n)
{
    const qdot_expr c = qdot_normal(t->pool, qdot_div(t->pool, u, qdot_pow_int(t->pool, t->x, n)), NULL);

    return c == QDOT_NIL || qdot_expr_contains(t->pool, c, t->x) ? QDOT_NIL : c;
}

/* Whether e is there and proved to be positive; not asked any more once the integral is found. */
static bool
is_proved_positive(table *t, qdot_expr e)
{
    qdot_decision d = {.verdict = QDOT_UNDECIDED};

    if (e == QDOT_NIL || t->value != QDOT_NIL || t->status != QDOT_OK)
        return false;
    t->status = qdot_decide_less(t->pool, QDOT_ZERO, e, true, t->facts, &d);
    return d.verdict == QDOT_PROVED;
}

/* Note the exponent u of an exponential. */
static void
read_exponent(table *t, qdot_expr u)
{
    const qdot_expr linear = factor_of_power(t, u, 1), square = factor_of_power(t, u, 2);

    if (square != QDOT_NIL)
        t->gauss = qdot_neg(t->pool, square);
    if (linear == QDOT_NIL)
        return;
    if (is_proved_positive(t, linear))
        t->grow = linear;
    else
        t->decay[t->decay[0] != QDOT_NIL] = qdot_neg(t->pool, linear);
}

/* Note p and q if the sum e is c (x^4 + p x^2 + q). */
static void
read_quartic(table *t, qdot_expr e)
{
    qdot_pool *pool = t->pool;
    const qdot_expr zero = QDOT_ZERO, constant = qdot_subs(pool, e, 1, &t->x, &zero);
    const qdot_expr slope = qdot_diff(pool, e, t->x), curvature = slope == QDOT_NIL ? slope : qdot_diff(pool, slope, t->x);
    const qdot_expr c2 = curvature == QDOT_NIL ? curvature
                                               : qdot_mul(pool, QDOT_HALF, qdot_subs(pool, curvature, 1, &t->x, &zero));
    const qdot_expr square = qdot_mul(pool, t->x, t->x);
    qdot_expr c4;

    if (constant == QDOT_NIL || c2 == QDOT_NIL)
        return;
    c4 = factor_of_power(t, qdot_sub(pool, e, qdot_add(pool, constant, qdot_mul(pool, c2, square))), 4);
    if (c4 == QDOT_NIL || c4 == QDOT_ZERO)
        return;
    t->p = qdot_div(pool, c2, c4);
    t->q = qdot_div(pool, constant, c4);
    c4 = qdot_sub(pool, qdot_mul(pool, t->p, t->p), qdot_mul(pool, qdot_expr_int(pool, 4), t->q));
    if (qdot_normal(pool, c4, NULL) == QDOT_ZERO) /* (x^2 + p/2)^2 */
        t->square = qdot_mul(pool, QDOT_HALF, t->p);
}

/* Note which of the numbers k, k2 ... the node e of the integrand shows, if any. */
static void
read_node(table *t, qdot_expr e)
{
    qdot_pool *pool = t->pool;

    if (!qdot_expr_contains(pool, e, t->x))
        return;
    if (qdot_expr_is_function(pool, e, QDOT_SIN) || qdot_expr_is_function(pool, e, QDOT_COS)) {
        const qdot_expr u = qdot_expr_arg(pool, e, 0), k = factor_of_power(t, u, 1), k2 = factor_of_power(t, u, 2);

        t->k = k != QDOT_NIL ? k : t->k;
        t->k2 = k2 != QDOT_NIL ? k2 : t->k2;
    } else if (qdot_expr_is_function(pool, e, QDOT_EXP)) {
        read_exponent(t, qdot_expr_arg(pool, e, 0));
    } else if (qdot_expr_kind(pool, e) == QDOT_SUM) {
        const qdot_expr slope = qdot_diff(pool, e, t->x), lead = slope == QDOT_NIL ? slope : factor_of_power(t, slope, 1);

        if (lead != QDOT_NIL && lead != QDOT_ZERO) /* c x^2 + s, lead = 2 c */
            t->square = qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), qdot_subs(pool, e, 1, &t->x, &(qdot_expr){QDOT_ZERO})),
                                 lead);
        else
            read_quartic(t, e);
    }
}

/* If e is c f with a c free of x: its integral is c times that of f. */
static bool
compare(table *t, qdot_expr f, qdot_expr integral)
{
    qdot_expr c;

    if (f == QDOT_NIL || f == QDOT_ZERO || t->value != QDOT_NIL || t->status != QDOT_OK)
        return false;
    c = qdot_normal(t->pool, qdot_div(t->pool, t->e, f), NULL);
    if (c == QDOT_NIL || qdot_expr_contains(t->pool, c, t->x))
        return false;
    t->value = qdot_mul(t->pool, c, integral);
    return true;
}

/* f(rate x^n) */
static qdot_expr
function_of(const table *t, qdot_fun_id f, qdot_expr rate, int64_t n)
{
    return qdot_fun1(t->pool, f, qdot_mul(t->pool, rate, qdot_pow_int(t->pool, t->x, n)));
}

/* The integral of cos(k x)/(x^4 + p x^2 + q), by residues; nil: the signs that it needs are not proved. */
static qdot_expr
quartic_integral(table *t, qdot_expr k)
{
    qdot_pool *pool = t->pool;
    const qdot_expr two = qdot_expr_int(pool, 2), four = qdot_expr_int(pool, 4), p = t->p, q = t->q;
    qdot_expr gap = p == QDOT_NIL ? p : qdot_sub(pool, qdot_mul(pool, four, q), qdot_mul(pool, p, p)), c, u, w, fall, wave;

    if (!is_proved_positive(t, q))
        return QDOT_NIL;
    if (is_proved_positive(t, gap)) { /* poles at u + i w and -u + i w */
        c = qdot_sqrt(pool, q);
        u = qdot_mul(pool, QDOT_HALF, qdot_sqrt(pool, qdot_sub(pool, qdot_mul(pool, two, c), p)));
        w = qdot_mul(pool, QDOT_HALF, qdot_sqrt(pool, qdot_add(pool, qdot_mul(pool, two, c), p)));
        fall = qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_mul(pool, k, w)));
        wave = qdot_add(pool, qdot_mul(pool, u, qdot_fun1(pool, QDOT_COS, qdot_mul(pool, k, u))),
                        qdot_mul(pool, w, qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, k, u))));
        return qdot_div(pool, qdot_product(pool, 3, (qdot_expr[]){QDOT_PI, fall, wave}),
                        qdot_product(pool, 4, (qdot_expr[]){four, u, w, c}));
    }
    gap = qdot_neg(pool, gap);
    if (!is_proved_positive(t, gap) || !is_proved_positive(t, p))
        return QDOT_NIL;
    gap = qdot_sqrt(pool, gap); /* poles at i u and i w */
    u = qdot_sqrt(pool, qdot_mul(pool, QDOT_HALF, qdot_sub(pool, p, gap)));
    w = qdot_sqrt(pool, qdot_mul(pool, QDOT_HALF, qdot_add(pool, p, gap)));
    fall = qdot_sub(pool, qdot_div(pool, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_mul(pool, k, u))), u),
                    qdot_div(pool, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_mul(pool, k, w))), w));
    return qdot_div(pool, qdot_product(pool, 3, (qdot_expr[]){QDOT_HALF, QDOT_PI, fall}), gap);
}

/* Compare with x^n cos(k x) or x^n sin(k x) over x^4 + p x^2 + q, n = 0 ... 3: derivatives by k of the integral for n = 0. */
static void
look_up_quartic(table *t, qdot_expr s, qdot_expr c)
{
    qdot_pool *pool = t->pool;
    const qdot_expr k = qdot_symbol_get(pool, QDOT_FORMAL, "rate#"), x2 = qdot_mul(pool, t->x, t->x);
    qdot_expr under, F = quartic_integral(t, k);

    if (F == QDOT_NIL)
        return;
    under = qdot_add(pool, qdot_mul(pool, x2, qdot_add(pool, x2, t->p)), t->q);
    for (int64_t n = 0; n <= 3 && F != QDOT_NIL; n++) { /* d/dk cos(k x) = -x sin(k x), d/dk sin(k x) = x cos(k x) */
        compare(t, qdot_div(pool, qdot_mul(pool, n % 2 == 0 ? c : s, qdot_pow_int(pool, t->x, n)), under),
                qdot_subs(pool, F, 1, &k, &t->k));
        F = qdot_diff(pool, F, k);
        F = F == QDOT_NIL || n % 2 == 1 ? F : qdot_neg(pool, F);
    }
}

/* Compare the integrand, which holds sin(k x) or cos(k x) with k > 0, with the entries of improper.h that hold these. */
static void
look_up_waves(table *t)
{
    qdot_pool *pool = t->pool;
    const qdot_expr x = t->x, k = t->k, s = function_of(t, QDOT_SIN, k, 1), c = function_of(t, QDOT_COS, k, 1);
    const qdot_expr half_pi = qdot_mul(pool, QDOT_HALF, QDOT_PI), ratio = qdot_div(pool, s, x), decay = t->decay[0];
    const qdot_expr root = qdot_sqrt(pool, x);

    compare(t, ratio, half_pi);
    compare(t, qdot_mul(pool, ratio, ratio), qdot_mul(pool, half_pi, k));
    compare(t, qdot_div(pool, qdot_sub(pool, QDOT_ONE, c), qdot_mul(pool, x, x)), qdot_mul(pool, half_pi, k));
    compare(t, qdot_div(pool, s, root), qdot_sqrt(pool, qdot_div(pool, half_pi, k)));
    compare(t, qdot_div(pool, c, root), qdot_sqrt(pool, qdot_div(pool, half_pi, k)));
    compare(t, qdot_div(pool, ratio, root), qdot_sqrt(pool, qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), QDOT_PI, k})));
    compare(t, qdot_div(pool, qdot_sub(pool, QDOT_ONE, c), qdot_mul(pool, x, root)),
            qdot_sqrt(pool, qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), QDOT_PI, k})));
    if (is_proved_positive(t, decay))
        compare(t, qdot_mul(pool, ratio, function_of(t, QDOT_EXP, qdot_neg(pool, decay), 1)),
                qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, k, decay)));
    if (is_proved_positive(t, t->gauss)) {
        const qdot_expr fall = qdot_div(pool, qdot_mul(pool, k, k), qdot_mul(pool, qdot_expr_int(pool, -4), t->gauss));

        compare(t, qdot_mul(pool, c, function_of(t, QDOT_EXP, qdot_neg(pool, t->gauss), 2)),
                qdot_product(pool, 3, (qdot_expr[]){QDOT_HALF, qdot_sqrt(pool, qdot_div(pool, QDOT_PI, t->gauss)),
                                                    qdot_fun1(pool, QDOT_EXP, fall)}));
    }
    if (is_proved_positive(t, t->square)) {
        const qdot_expr a = qdot_sqrt(pool, t->square), under = qdot_add(pool, qdot_mul(pool, x, x), t->square);
        const qdot_expr fall = qdot_mul(pool, half_pi, qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_mul(pool, a, k))));

        compare(t, qdot_div(pool, c, under), qdot_div(pool, fall, a));
        compare(t, qdot_div(pool, qdot_mul(pool, x, s), under), fall);
        compare(t, qdot_div(pool, c, qdot_mul(pool, under, under)),
                qdot_div(pool, qdot_mul(pool, fall, qdot_add(pool, QDOT_ONE, qdot_mul(pool, a, k))),
                         qdot_mul(pool, qdot_expr_int(pool, 2), qdot_pow_int(pool, a, 3))));
        compare(t, qdot_div(pool, qdot_mul(pool, x, s), qdot_mul(pool, under, under)),
                qdot_div(pool, qdot_mul(pool, fall, k), qdot_mul(pool, qdot_expr_int(pool, 2), a)));
    }
    look_up_quartic(t, s, c);
}

/* |B| (2 pi/k)^(n + 1)/(2 (n + 1)), B the Bernoulli number of n + 1. */
static qdot_expr
bernoulli_integral(const table *t, qdot_expr k, int64_t n)
{
    qdot_pool *pool = t->pool;
    const qdot_expr power = qdot_pow_int(pool, qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI), k), n + 1);
    qdot_expr result;
    fmpq_t B;

    fmpq_init(B);
    arith_bernoulli_number(B, (ulong)n + 1);
    fmpq_abs(B, B);
    fmpq_div_2exp(B, B, 1);
    result = qdot_div(pool, qdot_mul(pool, qdot_expr_fmpq(pool, B), power), qdot_expr_int(pool, n + 1));
    fmpq_clear(B);
    return result;
}

/* Compare the integrand, which holds neither sin(k x) nor cos(k x) with k > 0, with the entries of improper.h that hold
 * exponentials of x. */
static void
look_up_exponentials(table *t)
{
    qdot_pool *pool = t->pool;
    const qdot_expr rate = t->grow != QDOT_NIL ? t->grow : t->decay[0], a = t->decay[0], b = t->decay[1];

    if (is_proved_positive(t, a) && is_proved_positive(t, b))
        compare(t, qdot_div(pool,
                            qdot_sub(pool, function_of(t, QDOT_EXP, qdot_neg(pool, a), 1),
                                     function_of(t, QDOT_EXP, qdot_neg(pool, b), 1)),
                            t->x),
                qdot_fun1(pool, QDOT_LOG, qdot_div(pool, b, a)));
    if (!is_proved_positive(t, rate))
        return;
    for (int64_t n = 1; n <= MOST_POWER && t->value == QDOT_NIL; n += 2) {
        const qdot_expr up = qdot_pow_int(pool, t->x, n), E = function_of(t, QDOT_EXP, rate, 1);
        const qdot_expr whole = bernoulli_integral(t, rate, n);

        compare(t, qdot_div(pool, up, qdot_sub(pool, E, QDOT_ONE)), whole);
        compare(t, qdot_div(pool, up, qdot_add(pool, E, QDOT_ONE)),
                qdot_mul(pool, whole, qdot_expr_ratio(pool, (INT64_C(1) << n) - 1, INT64_C(1) << n)));
    }
}

/* Whether e(-x) = e(x). */
static bool
is_even(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    const qdot_expr opposite = qdot_neg(pool, x), other = qdot_subs(pool, e, 1, &x, &opposite);

    return other == e || (other != QDOT_NIL && qdot_normal(pool, qdot_sub(pool, other, e), NULL) == QDOT_ZERO);
}

qdot_status
qdot_improper(qdot_pool *pool, qdot_expr e, qdot_expr x, bool whole_line, const qdot_facts *facts, qdot_expr *value)
{
    table t = {.pool = pool, .facts = facts, .e = e, .x = x};
    qdot_walk w;

    *value = QDOT_NIL;
    if (whole_line && !is_even(pool, e, x))
        return qdot_grave(qdot_pool_check(pool));
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && t.status == QDOT_OK; i++)
        read_node(&t, w.at[i]);
    qdot_walk_end(&w);
    if (is_proved_positive(&t, t.k))
        look_up_waves(&t);
    else if (is_proved_positive(&t, t.k2))
        for (int i = 0; i < 2; i++)
            compare(&t, function_of(&t, i == 0 ? QDOT_SIN : QDOT_COS, t.k2, 2),
                    qdot_sqrt(pool, qdot_div(pool, QDOT_PI, qdot_mul(pool, qdot_expr_int(pool, 8), t.k2))));
    else
        look_up_exponentials(&t);
    QDOT_TRY(t.status);
    if (t.value != QDOT_NIL)
        *value = whole_line ? qdot_mul(pool, qdot_expr_int(pool, 2), t.value) : t.value;
    return qdot_grave(qdot_pool_check(pool));
}
