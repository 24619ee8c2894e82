/* elliptic-forms.c -- recognises integrands whose integrals are elliptic, and proves what it finds. */
#include "normal/calculus/elliptic-forms.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/calculus/expansion.h"
#include "normal/prove/decide.h"

enum { MOST_FACTORS = 2 };

/* constant + factor s^2, s = sin(v), or s = x where v is nil. */
typedef struct {
    qdot_expr constant, factor, v;
    int halves; /* the exponent, in halves: -2, -1, 1 */
} radicand;

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x, front; /* what does not hold x */
    radicand part[MOST_FACTORS];
    size_t n;
} integrand;

static bool
is_linear(const integrand *f, qdot_expr u)
{
    const qdot_expr slope = qdot_diff(f->pool, u, f->x);

    return slope != QDOT_NIL && slope != QDOT_ZERO && !qdot_expr_contains(f->pool, slope, f->x);
}

/* The part of a term that holds x; *rest: its other factors. */
static qdot_expr
split_term(const integrand *f, qdot_expr t, qdot_expr *rest)
{
    qdot_pool *pool = f->pool;
    qdot_expr held = QDOT_ONE;

    *rest = QDOT_ONE;
    if (qdot_expr_kind(pool, t) != QDOT_PROD)
        return t;
    *rest = qdot_expr_arg(pool, t, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, t); i += 2) {
        const qdot_expr power = qdot_pow(pool, qdot_expr_arg(pool, t, i), qdot_expr_arg(pool, t, i + 1));

        if (qdot_expr_contains(pool, power, f->x))
            held = qdot_mul(pool, held, power);
        else
            *rest = qdot_mul(pool, *rest, power);
    }
    return held;
}

/* Read R = a + b atom, with one atom that holds x. */
static bool
read_sum(const integrand *f, qdot_expr R, qdot_expr *a, qdot_expr *b, qdot_expr *atom)
{
    qdot_pool *pool = f->pool;

    if (qdot_expr_kind(pool, R) != QDOT_SUM)
        return false;
    *a = qdot_expr_arg(pool, R, 0);
    *b = QDOT_ZERO;
    *atom = QDOT_NIL;
    for (uint32_t i = 1; i < qdot_expr_count(pool, R); i += 2) {
        const qdot_expr t = qdot_expr_arg(pool, R, i), c = qdot_expr_arg(pool, R, i + 1);
        qdot_expr rest, held;

        if (!qdot_expr_contains(pool, t, f->x)) {
            *a = qdot_add(pool, *a, qdot_mul(pool, c, t));
            continue;
        }
        held = split_term(f, t, &rest);
        if (*atom != QDOT_NIL && held != *atom)
            return false;
        *atom = held;
        *b = qdot_add(pool, *b, qdot_mul(pool, c, rest));
    }
    return *atom != QDOT_NIL;
}

/* Write a + b atom as constant + factor s^2. */
static bool
write_radicand(const integrand *f, qdot_expr a, qdot_expr b, qdot_expr atom, radicand *r)
{
    qdot_pool *pool = f->pool;
    const bool square = qdot_expr_kind(pool, atom) == QDOT_PROD && qdot_expr_count(pool, atom) == 3 &&
                        qdot_expr_arg(pool, atom, 0) == QDOT_ONE && qdot_expr_arg(pool, atom, 2) == qdot_expr_int(pool, 2);
    const qdot_expr base = square ? qdot_expr_arg(pool, atom, 1) : atom;
    const bool sine = qdot_expr_is_function(pool, base, QDOT_SIN);
    qdot_expr u;

    *r = (radicand){.constant = a, .factor = b, .v = QDOT_NIL};
    if (square && base == f->x)
        return true;
    if ((!sine && !qdot_expr_is_function(pool, base, QDOT_COS)) || !is_linear(f, qdot_expr_arg(pool, base, 0)))
        return false;
    u = qdot_expr_arg(pool, base, 0);
    r->v = u;
    if (square && sine)
        return true;
    r->constant = qdot_add(pool, a, b);
    r->factor = qdot_neg(pool, b);
    if (square)
        return true;
    if (sine)
        u = qdot_sub(pool, u, qdot_mul(pool, QDOT_HALF, QDOT_PI));
    r->v = qdot_expand(pool, qdot_mul(pool, QDOT_HALF, u));
    r->factor = qdot_mul(pool, qdot_expr_int(pool, -2), b);
    return true;
}

/* Read e as front times powers of radicands. */
static bool
read_integrand(integrand *f, qdot_expr e)
{
    qdot_pool *pool = f->pool;
    const bool product = qdot_expr_kind(pool, e) == QDOT_PROD;

    f->front = product ? qdot_expr_arg(pool, e, 0) : QDOT_ONE;
    for (uint32_t i = 1; product && i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr R = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        qdot_expr a, b, atom;
        int64_t halves;

        if (!qdot_expr_contains(pool, R, f->x) && !qdot_expr_contains(pool, p, f->x)) {
            f->front = qdot_mul(pool, f->front, qdot_pow(pool, R, p));
            continue;
        }
        if (f->n == MOST_FACTORS || qdot_expr_rational(pool, p) == NULL ||
            !qdot_expr_to_int(pool, qdot_mul(pool, p, qdot_expr_int(pool, 2)), &halves) || halves < -2 || halves > 1 ||
            halves == 0 || !read_sum(f, R, &a, &b, &atom) || !write_radicand(f, a, b, atom, &f->part[f->n]))
            return false;
        f->part[f->n++].halves = (int)halves;
    }
    return f->n > 0;
}

static bool
is_positive(const integrand *f, qdot_expr e)
{
    return e != QDOT_NIL && qdot_proved_sign(f->pool, e, f->facts) == 1;
}

static qdot_expr
minus_quotient(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_neg(pool, qdot_div(pool, a, b));
}

/* P + Q sin(v)^2 = P + Q - Q sin(v - pi/2)^2. */
static void
turn_by_right_angle(const integrand *f, radicand *r)
{
    r->constant = qdot_add(f->pool, r->constant, r->factor);
    r->factor = qdot_neg(f->pool, r->factor);
    r->v = qdot_sub(f->pool, r->v, qdot_mul(f->pool, QDOT_HALF, QDOT_PI));
}

/* 1/sqrt(P + Q sin(v)^2) where the root vanishes within a quarter turn, -Q > P > 0. */
static qdot_expr
integral_between_zeros(qdot_pool *pool, const radicand *root, qdot_expr slope)
{
    const qdot_expr minus_Q = qdot_neg(pool, root->factor), m = qdot_div(pool, root->constant, minus_Q);
    const qdot_expr phi = qdot_fun1(pool, QDOT_ASIN, qdot_div(pool, qdot_fun1(pool, QDOT_SIN, root->v), qdot_sqrt(pool, m)));

    return qdot_div(pool, qdot_fun(pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){phi, m}), qdot_mul(pool, qdot_sqrt(pool, minus_Q), slope));
}

/* The forms with sin(v): one root, or one root and one denominator. */
static qdot_expr
integral_of_waves(integrand *f)
{
    qdot_pool *pool = f->pool;
    radicand *root = &f->part[f->n == 2 && f->part[0].halves == -2], *below = root == f->part ? f->part + 1 : f->part;
    qdot_expr P, m, slope, scale;

    if (!is_positive(f, root->constant))
        for (size_t i = 0; i < f->n; i++)
            turn_by_right_angle(f, &f->part[i]);
    P = root->constant;
    if (!is_positive(f, P))
        return QDOT_NIL;
    m = minus_quotient(pool, root->factor, P);
    slope = qdot_diff(pool, root->v, f->x);
    if (f->n == 1 && root->halves == -1 && is_positive(f, qdot_neg(pool, qdot_add(pool, P, root->factor))))
        return integral_between_zeros(pool, root, slope);
    scale = qdot_sqrt(pool, P);
    if (f->n == 1 && root->halves == 1)
        return qdot_div(pool, qdot_mul(pool, scale, qdot_fun(pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){root->v, m})), slope);
    if (f->n == 1 && root->halves == -1)
        return qdot_div(pool, qdot_fun(pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){root->v, m}), qdot_mul(pool, scale, slope));
    if (f->n != 2 || root->halves != -1 || below->halves != -2 || below->v != root->v)
        return QDOT_NIL;
    return qdot_div(pool,
                    qdot_fun(pool, QDOT_ELLIPTIC_PI, 3,
                             (qdot_expr[]){minus_quotient(pool, below->factor, below->constant), root->v, m}),
                    qdot_product(pool, 3, (qdot_expr[]){below->constant, scale, slope}));
}

/* The forms with two roots of a + b x^2, the first 1/sqrt(A + B x^2) with A > 0 > B. */
static qdot_expr
integral_of_roots(const integrand *f, const radicand *first, const radicand *second)
{
    qdot_pool *pool = f->pool;
    const qdot_expr A = first->constant, B = qdot_neg(pool, first->factor), C = second->constant, D = second->factor;
    qdot_expr v, m;

    if (first->halves != -1 || (second->halves != -1 && second->halves != 1) || !is_positive(f, A) || !is_positive(f, B) ||
        !is_positive(f, C))
        return QDOT_NIL;
    v = qdot_fun1(pool, QDOT_ASIN, qdot_mul(pool, f->x, qdot_sqrt(pool, qdot_div(pool, B, A))));
    m = minus_quotient(pool, qdot_mul(pool, A, D), qdot_mul(pool, B, C));
    if (second->halves == -1)
        return qdot_div(pool, qdot_fun(pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){v, m}), qdot_sqrt(pool, qdot_mul(pool, B, C)));
    return qdot_mul(pool, qdot_sqrt(pool, qdot_div(pool, C, B)), qdot_fun(pool, QDOT_ELLIPTIC_E, 2, (qdot_expr[]){v, m}));
}

static qdot_expr
find_form(integrand *f)
{
    qdot_expr found;

    if (f->part[0].v != QDOT_NIL)
        return f->n == 2 && f->part[1].v == QDOT_NIL ? QDOT_NIL : integral_of_waves(f);
    if (f->n != 2 || f->part[1].v != QDOT_NIL)
        return QDOT_NIL;
    found = integral_of_roots(f, &f->part[0], &f->part[1]);
    return found != QDOT_NIL ? found : integral_of_roots(f, &f->part[1], &f->part[0]);
}

qdot_expr
qdot_elliptic_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    integrand f = {.pool = pool, .facts = facts, .x = x};
    qdot_decision decision = {.verdict = QDOT_UNDECIDED};
    qdot_expr found = QDOT_NIL;
    qdot_status status;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (read_integrand(&f, e))
        found = find_form(&f);
    found = found == QDOT_NIL ? QDOT_NIL : qdot_mul(pool, f.front, found);
    status = qdot_pool_check(pool);
    if (status == QDOT_OK && found != QDOT_NIL)
        status = qdot_decide_equal(pool, qdot_diff(pool, found, x), e, facts, &decision);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    return status == QDOT_OK && decision.verdict == QDOT_PROVED ? found : QDOT_NIL;
}
